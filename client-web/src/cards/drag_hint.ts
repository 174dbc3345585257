// Shows that the picture can be dragged, to who has not touched it: once in each browser.

import { element } from '../core/dom';
import { keepSeen, wasSeen } from '../core/kept';

const kAfterMs = 3_000;
const kShownMs = 6_000;
const kInput = ['pointerdown', 'wheel', 'keydown'] as const;

export class DragHint {
  private readonly hint = element('hint', HTMLElement);
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly onInput = (): void => {
    keepSeen('drag-hint');
    this.end();
  };

  /** From now on there is a picture to drag. */
  pictureShown(): void {
    if (wasSeen('drag-hint') || matchMedia('(prefers-reduced-motion: reduce)').matches) return;
    for (const type of kInput) window.addEventListener(type, this.onInput, { capture: true, passive: true });
    this.timer = setTimeout(() => this.show(), kAfterMs);
  }

  private show(): void {
    this.hint.hidden = false;
    keepSeen('drag-hint');
    this.timer = setTimeout(() => this.end(), kShownMs);
  }

  private end(): void {
    clearTimeout(this.timer);
    this.hint.hidden = true;
    for (const type of kInput) window.removeEventListener(type, this.onInput, { capture: true });
  }
}
