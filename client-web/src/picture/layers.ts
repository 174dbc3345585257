// Both pictures of a comparison, which come one above the other, on one canvas with a divider.

import type { Size } from '../core/size';

/** The size of one of them. */
export const layerSize = ({ width, height }: Size): Size => ({ width, height: height / 2 });

export interface Strip {
  readonly from: number; // the first row of the picture of both
  readonly begin: number; // shares of the width
  readonly end: number;
}

/** What is painted for a divider at `split`, a share of the width: the upper picture left of it, the lower one beyond. */
export function stripsOf(split: number, { height }: Size): Strip[] {
  const strips = [
    { from: 0, begin: 0, end: split },
    { from: height / 2, begin: split, end: 1 },
  ];
  return strips.filter(({ begin, end }) => end > begin);
}
