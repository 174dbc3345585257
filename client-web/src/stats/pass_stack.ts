// The GPU passes of a frame as one stacked bar, and as a table beneath it.

import { element, make } from '../core/dom';
import { percent, timeText } from '../core/format';
import { sumOf, type PassShare } from './pass_meter';

/** Hues a golden angle apart. */
const passColor = (index: number): string =>
  `hsl(${((index * 137.508 + 215) % 360).toFixed(0)}deg 62% 54%)`;

/** A pass has its own, whichever passes were seen before it: a frame that keeps surfaces has fewer. The numbers were
 * searched for: passes that follow each other in a frame are 43 degrees apart. */
export const colorOfPass = (name: string): string =>
  passColor(Array.from(name).reduce((sum, letter) => (sum * 281 + letter.charCodeAt(0)) % 9973, 39));

export class PassStack {
  private readonly bar = element('passes-bar', HTMLElement);
  private readonly table = element('passes-table', HTMLTableElement);
  private built = '';

  show(passes: readonly PassShare[]): void {
    const names = passes.map(({ name }) => name).join(' ');
    if (names !== this.built) this.build(passes);
    this.built = names;
    passes.forEach((pass, index) => {
      const segment = this.bar.children[index];
      if (segment instanceof HTMLElement) segment.style.flexGrow = (pass.share ?? 0).toFixed(4);
      this.fillRow(index, pass.ms, pass.share);
    });
    const whole = sumOf(passes.map(({ ms }) => ms));
    this.fillRow(passes.length, whole, whole === null ? null : whole > 0 ? 1 : 0);
  }

  private build(passes: readonly PassShare[]): void {
    const parts = passes.map(({ name }) => {
      const color = colorOfPass(name);
      const text = name.replaceAll('_', ' ');
      const segment = make('span');
      segment.style.background = color;
      segment.title = text;
      const row = this.makeRow(text);
      row.style.setProperty('--key', color);
      return { segment, row };
    });
    this.bar.replaceChildren(...parts.map(({ segment }) => segment));
    this.table.replaceChildren(
      ...parts.map(({ row }) => row),
      ...(parts.length > 0 ? [this.makeRow('together')] : []),
    );
  }

  private makeRow(name: string): HTMLTableRowElement {
    const row = make('tr');
    row.append(make('th', name), make('td'), make('td'));
    return row;
  }

  private fillRow(index: number, timeMs: number | null, share: number | null): void {
    const [, time, part] = this.table.rows[index]?.cells ?? [];
    if (time) time.textContent = timeText(timeMs);
    if (part) part.textContent = share === null ? '' : percent(share, 1);
  }
}
