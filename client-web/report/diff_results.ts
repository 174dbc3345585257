// What `froxel diff` puts into its report; server/app/diff_report.cpp writes it.

import { readReport } from './read';

export interface FirstPixel {
  readonly x: number;
  readonly y: number;
  readonly picture: readonly number[]; // colours from 0 to 1, or radiance
  readonly reference: readonly number[];
}

export interface Difference {
  readonly width_px: number;
  readonly height_px: number;
  readonly unit: 'srgb' | 'radiance';
  readonly equal: boolean;
  readonly flip: number | null; // null: a value is not finite
  readonly rmse: number | null;
  readonly max: number | null;
  readonly mssim: number | null;
  readonly pixels: number;
  readonly differing: number;
  readonly nonfinite: number;
  readonly first: FirstPixel | null;
}

/** Data URLs. */
export interface Pictures {
  readonly picture: string;
  readonly reference: string;
  readonly flip?: string;
}

export interface Pair {
  readonly name: string;
  readonly failed: boolean;
  readonly faults: readonly string[];
  readonly difference: Difference | null;
  readonly pictures?: Pictures; // of the worst pairs
}

export interface DiffResults {
  readonly schema: string;
  readonly version: string;
  readonly picture: string;
  readonly reference: string;
  readonly failed: number;
  readonly pairs: readonly Pair[];
}

export const readDiff = (text: string): DiffResults => readReport(text, 'froxel.diff.v1', 'diff');
