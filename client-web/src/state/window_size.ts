// Keeps the picture's size with the window's while the size mode is automatic.

import type { Size } from '../core/size';
import type { AppState } from './app_state';
import { autoSize, sizeModeFor } from './size_policy';
import type { Store } from './store';

/** While a window is dragged to a new size only a few of the sizes on the way are asked for. */
const kSettleMs = 120;

export class WindowSize {
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly store: Store,
    private readonly canvas: HTMLElement,
  ) {
    store.listen((state, before) => {
      if (state.server !== before.server || state.sizeMode !== before.sizeMode) this.apply(state);
    });
    new ResizeObserver(() => {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.apply(this.store.state), kSettleMs);
    }).observe(canvas);
  }

  private apply({ server, settings, sizeMode }: AppState): void {
    if (!server || !settings) return;
    const canvas = this.canvasSize();
    if (sizeMode === null) {
      this.store.dispatch({ type: 'size_mode', mode: sizeModeFor(canvas, server.initial) });
      return;
    }
    const width = server.ranges.get('width');
    const height = server.ranges.get('height');
    if (sizeMode.kind !== 'auto' || !width || !height) return;
    const size = autoSize(canvas, sizeMode.scale, width, height);
    if (size.width !== settings.width || size.height !== settings.height) {
      this.store.dispatch({ type: 'edit', patch: size });
    }
  }

  /** In device pixels. */
  private canvasSize(): Size {
    const ratio = window.devicePixelRatio;
    return {
      width: Math.max(1, Math.round(this.canvas.clientWidth * ratio)),
      height: Math.max(1, Math.round(this.canvas.clientHeight * ratio)),
    };
  }
}
