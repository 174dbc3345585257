// Chooses what the right side of a comparison has otherwise.

import { appended, closeBeside, element, make } from '../core/dom';
import type { Field } from '../settings/field';
import { changesOf, rightOf, withChange, type Change } from '../settings/comparison';
import { choicesFor } from '../settings/fields';
import { kRows } from '../settings/setting_table';
import type { Settings } from '../settings/settings';
import { labelOf, type WordBook } from './words';

export interface CompareChoice {
  edit(patch: Partial<Settings>): void;
  comparison(): string;
}

const kHtml = `
  <dialog id="compare-card" aria-labelledby="compare-card-title">
    <h1 id="compare-card-title">Compare</h1>
    <p>The left side shows the settings as they are. The right side shows the same frame with these settings changed:</p>
    <div id="compare-ready" role="group" aria-label="Often compared"></div>
    <ul id="compare-changes"></ul>
    <select id="compare-add" aria-label="Add a setting"></select>
    <p>
      <button id="compare-card-end" type="button">End the comparison</button>
      <button id="compare-card-close" type="button">Close</button>
    </p>
  </dialog>`;

/** What people compare first. */
const kReady: readonly (readonly [string, string])[] = [
  ['Naive', 'renderer:naive'],
  ['Clustered deferred', 'renderer:clustered_deferred'],
  ['All lights, no lists', 'light_loop:all_lights'],
  ['Lists of 8 lights', 'list_cap:8'],
  ['Light cutoff 0.02', 'light_cutoff:0.02'],
  ['Lambert', 'shading:lambert'],
  ['4 samples for each pixel', 'antialiasing:ssaa4'],
  ['JPEG quality 30', 'quality:30'],
];

/** Settings that may differ, by the server's word. */
export const comparable = (book: WordBook): Field[] => kRows.filter(({ name }) => book.get(name)?.compares === true);

/** What a setting that is added begins with. */
export function firstText(field: Field): string {
  if (field.kind === 'choice') return choicesFor(field)[0]?.name ?? '';
  return field.kind === 'boolean' ? '1' : '0';
}

export class CompareCard {
  private readonly dialog = appended(kHtml, 'compare-card', HTMLDialogElement);
  private readonly list = element('compare-changes', HTMLElement);
  private readonly add = element('compare-add', HTMLSelectElement);
  private fields: readonly Field[] = [];

  constructor(
    private readonly actions: CompareChoice,
    private readonly book: WordBook,
  ) {
    closeBeside(this.dialog);
    this.fields = comparable(book);
    element('compare-ready', HTMLElement).append(
      ...kReady.map(([label, right]) => {
        const button = make('button', label);
        button.type = 'button';
        button.addEventListener('click', () => {
          this.choose(right);
          this.dialog.close();
        });
        return button;
      }),
    );
    this.add.addEventListener('change', () => this.addChange());
    element('compare-card-end', HTMLButtonElement).addEventListener('click', () => {
      this.choose('');
      this.dialog.close();
    });
    element('compare-card-close', HTMLButtonElement).addEventListener('click', () => this.dialog.close());
  }

  toggle(): void {
    if (this.dialog.open) {
      this.dialog.close();
      return;
    }
    this.build();
    this.dialog.showModal();
  }

  private get changes(): Change[] {
    return changesOf(this.actions.comparison());
  }

  private choose(right: string): void {
    this.actions.edit({ compare: right, ...(right === '' && { compareHeatMap: false }) });
    this.build();
  }

  private addChange(): void {
    const field = this.fields.find(({ name }) => name === this.add.value);
    if (field) this.choose(rightOf(withChange(this.changes, { name: field.name, text: firstText(field) })));
  }

  private build(): void {
    const { changes } = this;
    this.list.replaceChildren(...changes.map((change) => this.itemOf(change)));
    const left = this.fields.filter(({ name }) => changes.every((change) => change.name !== name));
    this.add.replaceChildren(
      new Option('Add a setting…', ''),
      ...left.map(({ name }) => new Option(labelOf(name, this.book), name)),
    );
    element('compare-card-end', HTMLButtonElement).hidden = changes.length === 0;
  }

  private itemOf(change: Change): HTMLElement {
    const item = make('li');
    const label = labelOf(change.name, this.book);
    const drop = make('button', '×', 'plain');
    drop.type = 'button';
    drop.setAttribute('aria-label', `The same on both sides: ${label}`);
    drop.addEventListener('click', () => this.choose(rightOf(this.changes.filter(({ name }) => name !== change.name))));
    item.append(make('span', label), this.inputOf(change, label), drop);
    return item;
  }

  private inputOf({ name, text }: Change, label: string): HTMLElement {
    const field = this.fields.find((known) => known.name === name);
    const input = field?.kind === 'number' || !field ? this.numberInput(text) : choiceInput(field, text);
    input.setAttribute('aria-label', `${label} on the right`);
    input.addEventListener('change', () => {
      if (input.value !== '') this.choose(rightOf(withChange(this.changes, { name, text: input.value })));
    });
    return input;
  }

  private numberInput(text: string): HTMLInputElement {
    const input = make('input');
    input.type = 'number';
    input.step = 'any';
    input.value = text;
    return input;
  }
}

function choiceInput(field: Field, text: string): HTMLSelectElement {
  const input = make('select');
  const names = field.kind === 'choice' ? choicesFor(field).map(({ name }) => name) : ['1', '0'];
  const words = (name: string): string =>
    field.kind === 'choice' ? name.replaceAll('_', ' ') : name === '1' ? 'on' : 'off';
  input.append(...names.map((name) => new Option(words(name), name, false, name === text)));
  return input;
}
