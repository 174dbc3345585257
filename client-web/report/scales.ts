// Axes: logarithmic ones with a place for zero, and ticks whose labels do not touch.

/** A logarithmic axis; zero, which has no logarithm, stands on `floor`. */
export interface LogAxis {
  readonly domain: readonly [number, number];
  readonly floor: number | null; // null: no value is zero
  readonly ticks: readonly number[];
  /** Where a value stands: itself, or the floor. */
  readonly place: (value: number) => number;
  /** The same as a share of the axis' length, 0 to 1. */
  readonly share: (value: number) => number;
  readonly label: (tick: number) => string;
}

const kSteps = [1, 2, 5] as const;
const kGap = 10 ** 0.5; // between the floor and the least positive value's step

const kSuffixes = [
  [1e9, 'G'],
  [1e6, 'M'],
  [1e3, 'k'],
] as const;

/** Short: 0, 0.002, 15, 2.5k, 1M, 3e-5. */
export function shortNumber(value: number): string {
  const size = Math.abs(value);
  for (const [unit, suffix] of kSuffixes) {
    if (size >= unit * 0.9995) return `${Number((value / unit).toPrecision(3))}${suffix}`;
  }
  if (size === 0 || size >= 1e-3) return String(Number(value.toPrecision(3)));
  return value.toExponential(1).replace('.0e', 'e');
}

const stepBelow = (value: number): number => {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  const step = [...kSteps].reverse().find((factor) => factor * power <= value * (1 + 1e-9));
  return (step ?? 1) * power;
};

const stepAbove = (value: number): number => {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  const step = [...kSteps, 10].find((factor) => factor * power >= value * (1 - 1e-9));
  return (step ?? 10) * power;
};

/** Ticks at powers of ten, and at 2 and 5 times these where there would be fewer than four. */
export function logTicks(low: number, high: number): number[] {
  const ticks = (factors: readonly number[]): number[] => {
    const found: number[] = [];
    for (
      let power = Math.floor(Math.log10(low));
      power <= Math.ceil(Math.log10(high));
      power += 1
    ) {
      for (const factor of factors) {
        const tick = Number(`${factor}e${power}`);
        if (tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9)) found.push(tick);
      }
    }
    return found;
  };
  const decades = ticks([1]);
  return decades.length >= 4 ? decades : ticks(kSteps);
}

/** Around values of 0 or more; negative ones and NaN are a bug of the caller. */
export function logAxis(values: readonly number[]): LogAxis {
  const positive = values.filter((value) => value > 0);
  const low = positive.length > 0 ? stepBelow(Math.min(...positive)) : 1;
  let high = positive.length > 0 ? stepAbove(Math.max(...positive)) : 1;
  if (high <= low) high = low * 10;
  const floor = positive.length < values.length ? low / kGap : null;
  const ticks = logTicks(low, high);
  const least = floor ?? low;
  const place = (value: number): number => (value > 0 ? value : least);
  return {
    domain: [least, high],
    floor,
    ticks: floor === null ? ticks : [floor, ...ticks],
    place,
    share: (value) => Math.log(place(value) / least) / Math.log(high / least),
    label: (tick) => (tick === floor ? '0' : shortNumber(tick)),
  };
}

/** Of ascending positions those at least `gap` from the last kept; the last of all stays. */
export function apart(positions: readonly number[], gap: number): number[] {
  const kept: number[] = [];
  for (const [index, at] of positions.entries()) {
    const last = kept.at(-1);
    if (last === undefined || at - (positions[last] ?? 0) >= gap) kept.push(index);
  }
  const end = positions.length - 1;
  if (end > 0 && kept.at(-1) !== end) {
    if (kept.length > 1) kept.pop();
    kept.push(end);
  }
  return kept;
}

/** Which of the points have room for a label: not both across and along closer than `gap` to one before. */
export function clear(points: readonly { x: number; y: number }[], gap: number): boolean[] {
  const kept: { x: number; y: number }[] = [];
  return points.map((point) => {
    const free = kept.every(
      ({ x, y }) => Math.abs(x - point.x) >= gap || Math.abs(y - point.y) >= gap,
    );
    if (free) kept.push(point);
    return free;
  });
}

/** Whether values that are all positive span so much that only a logarithmic axis shows them. */
export const spansDecades = (values: readonly number[]): boolean =>
  values.length > 0 && Math.min(...values) > 0 && Math.max(...values) / Math.min(...values) > 8;
