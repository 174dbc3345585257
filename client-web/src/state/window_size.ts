// Keeps the picture's size with the window's while the size mode is automatic.

import type { Size } from '../core/size';
import type { AppState } from './app_state';
import { autoSize, sizeModeFor } from './size_policy';
import type { Store } from './store';

/** While a window is dragged to a new size only a few of the sizes on the way are asked for. */
const kSettleMs = 120;
/** A window that is smaller is not being looked at: a background tab's, or one that is about to open. */
const kLeastPx = 16;

export class WindowSize {
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly store: Store,
    private readonly canvas: HTMLElement,
  ) {
    store.listen((state, before) => {
      if (state.server !== before.server || state.sizeMode !== before.sizeMode) this.apply(state);
    });
    const settle = (): void => {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.apply(this.store.state), kSettleMs);
    };
    new ResizeObserver(settle).observe(canvas);
    this.watchRatio(settle);
  }

  /** Another monitor or a zoomed page has other pixels at the same size, which no observer of it tells. */
  private watchRatio(settle: () => void): void {
    const query = window.matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    const changed = (): void => {
      settle();
      this.watchRatio(settle);
    };
    query.addEventListener('change', changed, { once: true });
  }

  private apply({ server, settings, sizeMode }: AppState): void {
    const canvas = this.canvasSize();
    if (!server || !settings || !canvas) return;
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

  /** In device pixels; null while the page is hidden away, when its size means nothing yet. */
  private canvasSize(): Size | null {
    const { clientWidth, clientHeight } = this.canvas;
    if (Math.min(clientWidth, clientHeight) < kLeastPx) return null;
    const ratio = window.devicePixelRatio;
    return { width: Math.round(clientWidth * ratio), height: Math.round(clientHeight * ratio) };
  }
}
