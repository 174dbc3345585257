// The picture's size in pixels that fits a canvas.

import type { Size } from '../core/size';
import type { Range } from '../settings/field';

/** How the picture's size follows the window, or does not. */
export type SizeMode =
  | { readonly kind: 'auto'; readonly scale: number }
  | { readonly kind: 'fixed' };

/**
 * Canvas size in device pixels times `scale`, the shape kept: what would pass `max` on one side is
 * shrunk on both. Every side is at least `min`.
 */
export function autoSize(canvas: Size, scale: number, width: Range, height: Range): Size {
  const fit = Math.min(scale, width.max / canvas.width, height.max / canvas.height);
  return {
    width: Math.max(width.min, Math.round(canvas.width * fit)),
    height: Math.max(height.min, Math.round(canvas.height * fit)),
  };
}

/**
 * The automatic mode that costs a canvas about as many pixels as the server's own default size:
 * the server knows what its device can do. In steps of 5 %.
 */
export function sizeModeFor(canvas: Size, budget: Size): SizeMode {
  const ratio = (budget.width * budget.height) / (canvas.width * canvas.height);
  const scale = Math.floor(Math.sqrt(ratio) * 20) / 20;
  return { kind: 'auto', scale: Math.max(0.05, Math.min(1, scale)) };
}
