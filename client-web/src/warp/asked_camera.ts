// The camera that the server is asked for while the view moves: where the view will be when the
// picture shows, and a little wider. The picture is then warped by what the prediction missed and
// not by all of the delay, and its edges are there to be warped.

import { add, dot, length, scale, sub, vec, type Vec } from '../core/vec3';
import type { CameraPose, CameraSettings } from '../settings/settings';

/** Of poses that tell the speed. */
const kSpanMs = 100;
/** Shorter ones say too little: input comes in steps. */
const kLeastHalfMs = 10;
/** A hand turns back within longer times. */
const kLongestLeadMs = 100;
/** How far the view may be predicted to turn, or to come closer to its target, in distances to it. */
const kLargestChange = 0.25;
/** Of the view's width and height, beyond each of its edges. */
const kGuard = 0.05;
/** A view as wide as this shows enough, and its edges are stretched. */
const kWideDeg = 110;

interface Sample extends CameraPose {
  readonly atMs: number;
}

export class AskedCamera {
  private samples: Sample[] = [];

  /** `camera` is the view's now, one frame after another; it will be shown `leadMs` later. */
  of<Camera extends CameraSettings>(camera: Camera, nowMs: number, leadMs: number): Camera {
    const { eye, target } = camera;
    const speed = this.speedOf(camera, nowMs);
    if (!speed) return camera;
    const lead = Math.min(leadMs, kLongestLeadMs);
    const [eyeStep, targetStep] = [scale(speed.eye, lead), scale(speed.target, lead)];
    const most = kLargestChange * length(sub(target, eye));
    const change = length(sub(targetStep, eyeStep));
    const share = change > most ? most / change : 1;
    return widened({ ...camera, eye: add(eye, scale(eyeStep, share)), target: add(target, scale(targetStep, share)) });
  }

  /** Null: it rests, or begins or ends to move. */
  private speedOf({ eye, target, up }: CameraPose, nowMs: number): Speed | null {
    const now: Sample = { eye, target, up, atMs: nowMs };
    this.samples = [...this.samples.filter(({ atMs }) => atMs >= nowMs - kSpanMs && atMs < nowMs), now];
    const [first, middle] = [this.samples[0], this.samples[this.samples.length >> 1]];
    const halves = first && middle && ([speedBetween(first, middle), speedBetween(middle, now)] as const);
    if (!halves?.[0] || !halves[1]) return null;
    const speed = { eye: steady(halves[0].eye, halves[1].eye), target: steady(halves[0].target, halves[1].target) };
    return length(speed.eye) + length(speed.target) > 0 ? speed : null;
  }
}

/** Metres a millisecond. */
interface Speed {
  readonly eye: Vec;
  readonly target: Vec;
}

function speedBetween(from: Sample, to: Sample): Speed | null {
  const ms = to.atMs - from.atMs;
  if (ms < kLeastHalfMs) return null;
  return { eye: scale(sub(to.eye, from.eye), 1 / ms), target: scale(sub(to.target, from.target), 1 / ms) };
}

/** The slower of two speeds one after the other; none where a camera jumped, stopped or turned back. */
function steady(before: Vec, after: Vec): Vec {
  if (dot(before, after) <= 0) return vec(0, 0, 0);
  return length(before) < length(after) ? before : after;
}

function widened<Camera extends CameraSettings>(camera: Camera): Camera {
  if (camera.fovDeg > kWideDeg) return camera;
  const by = 1 + 2 * kGuard;
  return {
    ...camera,
    fovDeg: (Math.atan(by * Math.tan((camera.fovDeg * Math.PI) / 360)) * 360) / Math.PI,
    lensShiftX: camera.lensShiftX / by, // in half pictures, which are larger
    lensShiftY: camera.lensShiftY / by,
  };
}
