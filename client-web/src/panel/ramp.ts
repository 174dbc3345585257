// Toon ramps: cubic Hermite curves through control points, constant outside.

import type { Ramp, RampPoint } from '../settings/settings';

/** The curve's value at `x`, as the shaders compute it. */
export function evaluate(ramp: Ramp, x: number): number {
  const first = ramp[0];
  const last = ramp[ramp.length - 1];
  if (!first || !last) return 0;
  if (x <= first.x) return first.y;
  if (x >= last.x) return last.y;
  const index = ramp.findIndex((point) => point.x > x);
  const a = ramp[index - 1] ?? first;
  const b = ramp[index] ?? last;
  const width = b.x - a.x;
  const t = (x - a.x) / width;
  const t2 = t * t;
  const t3 = t2 * t;
  return (
    (2 * t3 - 3 * t2 + 1) * a.y +
    (t3 - 2 * t2 + t) * width * a.slope +
    (3 * t2 - 2 * t3) * b.y +
    (t3 - t2) * width * b.slope
  );
}

/** A point moved as far as its neighbours and the unit square allow: x stays in ascending order. */
export function dragged(ramp: Ramp, index: number, x: number, y: number): Ramp {
  const gap = 0.001;
  const low = index > 0 ? (ramp[index - 1]?.x ?? 0) + gap : 0;
  const high = index < ramp.length - 1 ? (ramp[index + 1]?.x ?? 1) - gap : 1;
  const round = (value: number): number => Math.round(value * 1000) / 1000;
  return replaced(ramp, index, {
    x: round(Math.min(high, Math.max(low, x))),
    y: round(Math.min(1, Math.max(0, y))),
  });
}

export function replaced(ramp: Ramp, index: number, change: Partial<RampPoint>): Ramp {
  return ramp.map((point, i) => (i === index ? { ...point, ...change } : point));
}

/** A new point on the curve in the middle of the gap after (or, for the last, before) `index`. */
export function inserted(ramp: Ramp, index: number): { ramp: Ramp; index: number } {
  const at = Math.min(index, ramp.length - 2) + 1;
  const a = ramp[at - 1];
  const b = ramp[at];
  if (!a || !b) return { ramp, index };
  const x = (a.x + b.x) / 2;
  const point = { x, y: evaluate(ramp, x), slope: 0 };
  return { ramp: [...ramp.slice(0, at), point, ...ramp.slice(at)], index: at };
}

export function removed(ramp: Ramp, index: number): Ramp {
  return ramp.filter((_, i) => i !== index);
}
