// How a view that somebody else steers moves between pictures: the newest one is shown from where the
// view was, and evenly from there to its own camera until the next one is due. That is as much later
// as pictures are apart, and at the rate of the display.

import { add, normalize, scale, type Vec } from '../core/vec3';
import { warpCamera, type WarpCamera } from './warp_matrix';

/** Pictures that are less far apart move evenly by themselves. */
const kShortestMs = 25;
/** After a longer pause the view begins to move, or another one is shown. */
const kLongestMs = 250;
/** Of a pause's difference from those before it: networks are uneven. */
const kNewShare = 0.2;

export class Glide {
  private from: WarpCamera | null = null;
  private to: WarpCamera | null = null;
  private beginMs = 0;
  private durationMs = 0; // 0: it is there
  private usualMs = 0; // from a picture to the next; 0: unknown

  /** A picture from `camera` is there; null: one that shows as it is. */
  start(camera: WarpCamera | null, nowMs: number): void {
    const pauseMs = nowMs - this.beginMs;
    this.from = this.at(nowMs);
    this.to = camera;
    this.beginMs = nowMs;
    if (pauseMs > kLongestMs) this.usualMs = this.durationMs = 0;
    else {
      this.usualMs = this.usualMs === 0 ? pauseMs : this.usualMs + kNewShare * (pauseMs - this.usualMs);
      this.durationMs = this.usualMs < kShortestMs ? 0 : this.usualMs;
    }
  }

  /** The camera of a time; the picture's own, as it came, when it is there. */
  at(nowMs: number): WarpCamera | null {
    const { from, to, durationMs } = this;
    const share = durationMs === 0 ? 1 : (nowMs - this.beginMs) / durationMs;
    return !from || !to || share >= 1 ? to : between(from, to, Math.max(0, share));
  }
}

/** Of two cameras that are near one another. */
function between(from: WarpCamera, to: WarpCamera, share: number): WarpCamera {
  const number = (a: number, b: number): number => a + (b - a) * share;
  const vector = (a: Vec, b: Vec): Vec => add(scale(a, 1 - share), scale(b, share));
  return warpCamera({
    eye: vector(from.eye, to.eye),
    right: normalize(vector(from.right, to.right), to.right),
    up: normalize(vector(from.up, to.up), to.up),
    halfHeight: number(from.halfHeight, to.halfHeight),
    lensShiftX: number(from.lensShiftX, to.lensShiftX),
    lensShiftY: number(from.lensShiftY, to.lensShiftY),
  });
}
