// How to read a debug view: what its colours say, and the scale of a heat map.

import { element } from '../core/dom';
import { tidy } from '../core/format';
import type { DebugLegend } from '../gen/froxel/v1/server_pb';

/** The scale's colours as a CSS gradient, from its least value on the left. */
export function gradientOf(colors: readonly number[]): string {
  const stops = colors.map((color) => `#${color.toString(16).padStart(6, '0')}`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

/** The scale's ends; the upper one stands for more, too. */
export function endsOf({ min, max, unit }: DebugLegend): [string, string] {
  return [String(tidy(min)), `${tidy(max)} ${unit}`];
}

export class Legend {
  private readonly card = element('legend', HTMLElement);
  private readonly words = element('legend-words', HTMLElement);
  private readonly scale = element('legend-scale', HTMLElement);
  private readonly bar = element('legend-bar', HTMLElement);
  private readonly min = element('legend-min', HTMLElement);
  private readonly max = element('legend-max', HTMLElement);

  show(legend: DebugLegend | undefined): void {
    this.card.hidden = !legend;
    if (!legend) return;
    this.words.textContent = legend.words;
    this.scale.hidden = legend.colors.length === 0;
    this.bar.style.background = gradientOf(legend.colors);
    [this.min.textContent, this.max.textContent] = endsOf(legend);
  }
}
