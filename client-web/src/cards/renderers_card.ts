// The renderers to choose from, each with what it does and what a frame of it took.

import { closeBeside, element, make } from '../core/dom';
import { ms } from '../core/format';
import { Renderer } from '../gen/froxel/v1/common_pb';
import { kRenderers } from '../state/renderers';
import type { KnownCosts } from './looks_card';

export interface RendererActions {
  /** The one that draws; null: there is no view yet. */
  renderer(): Renderer | null;
  chooseRenderer(renderer: Renderer): void;
  /** Of the commands that set the view. */
  newestSeq(): bigint;
}

const costName = (renderer: Renderer): string => `renderer:${renderer}`;

export class RenderersCard {
  private readonly dialog = element('renderers', HTMLDialogElement);
  private readonly list = element('renderers-list', HTMLElement);

  constructor(
    private readonly actions: RendererActions,
    private readonly costs: KnownCosts,
  ) {
    closeBeside(this.dialog);
    element('renderers-close', HTMLButtonElement).addEventListener('click', () => this.dialog.close());
  }

  toggle(): void {
    if (this.dialog.open) {
      this.dialog.close();
      return;
    }
    this.noteCost();
    this.list.replaceChildren(...kRenderers.map(({ renderer, label, help }) => this.itemOf(renderer, label, help)));
    this.dialog.showModal();
    this.list.querySelector<HTMLElement>('[aria-current]')?.focus();
  }

  /** What is drawn now was drawn by this one. To be called before it is another's. */
  noteCost(): void {
    const renderer = this.actions.renderer();
    if (renderer !== null) this.costs.note([costName(renderer)], this.actions.newestSeq());
  }

  private itemOf(renderer: Renderer, label: string, help: string): HTMLElement {
    const item = make('li');
    const choose = make('button');
    choose.type = 'button';
    const cost = this.costs.ofMs(costName(renderer));
    const figure = make('small', cost === undefined ? 'not drawn here yet' : `${ms(cost)} ms a frame`);
    figure.title = 'Device time of a frame when this renderer last drew the view';
    choose.append(make('b', label), figure, make('span', help));
    if (renderer === this.actions.renderer()) choose.setAttribute('aria-current', 'true');
    choose.addEventListener('click', () => {
      this.noteCost();
      this.dialog.close();
      this.actions.chooseRenderer(renderer);
    });
    item.append(choose);
    return item;
  }
}
