// Slider positions to values. Ranges that span decades get a logarithmic scale; 0, where it is in
// the range, is the slider's left end. Positions are 0 to kSliderSteps; values are rounded to what
// a hand can mean, but for the range's ends.

import { kMaxUint32, type NumberKind, type Range } from '../settings/field';

export const kSliderSteps = 1000;
/** Where nobody says how far down it reaches, one whose range starts at 0 does to this part of the usual value. */
const kSmallestPart = 1e-3;
const kDigits = 3;
const kLogRatio = 1000; // of a range's ends, from which on its scale is logarithmic
const kLogMax = 100; // the same for a range that starts at 0
const kLowest = -10; // a range further below 0 spans decades on both sides, as no scale here does

export interface Scale {
  toValue(position: number): number;
  toPosition(value: number): number;
}

/** The scale that suits a number's range; null: none does, its numbers are typed. */
export function scaleFor(range: Range, number: NumberKind, usual: number): Scale | null {
  const { min, max } = range;
  if (number.angle) return linearScale(range, number.integer);
  if (min < kLowest || max >= kMaxUint32) return null;
  const decades = min > 0 ? max / min >= kLogRatio : min === 0 && max >= kLogMax;
  return decades ? logScale(range, number, usual) : linearScale(range, number.integer);
}

export function linearScale({ min, max }: Range, integer: boolean): Scale {
  return {
    toValue: (position) => {
      if (position >= kSliderSteps) return max;
      return tidy(min + ((max - min) * position) / kSliderSteps, integer, min, max);
    },
    toPosition: (value) => clampPosition(((value - min) / (max - min)) * kSliderSteps),
  };
}

export function logScale({ min, max }: Range, number: NumberKind, usual: number): Scale {
  const { integer, softMin } = number;
  const least = softMin ?? (integer ? 1 : (usual > 0 ? usual : 1) * kSmallestPart);
  const floor = min > 0 ? min : least;
  const span = Math.log(max / floor);
  return {
    toValue: (position) => {
      if (position <= 0) return min;
      if (position >= kSliderSteps) return max;
      return tidy(floor * Math.exp((span * position) / kSliderSteps), integer, min, max);
    },
    toPosition: (value) => {
      if (value <= min) return 0;
      return Math.max(1, clampPosition((Math.log(value / floor) / span) * kSliderSteps));
    },
  };
}

function tidy(value: number, integer: boolean, min: number, max: number): number {
  const rounded = Number(value.toPrecision(kDigits));
  return Math.min(max, Math.max(min, integer ? Math.round(rounded) : rounded));
}

function clampPosition(position: number): number {
  return Math.min(kSliderSteps, Math.max(0, Math.round(position)));
}
