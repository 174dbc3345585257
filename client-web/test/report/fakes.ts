// Results of `froxel bench` for the report's tests: a committed run, and invented rows.

import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

import {
  readResults,
  type PictureError,
  type Results,
  type Row,
  type Sweep,
} from '../../report/results';

export const kSamplePath = fileURLToPath(
  new URL('../../../tests/bench/results/lavapipe_hall.json', import.meta.url),
);
/** A run of `froxel load` with stages, on lavapipe. */
export const kLoadSamplePath = fileURLToPath(new URL('load_sample.json', import.meta.url));
/** `froxel diff` of two folders: an equal pair, one that differs, and a picture without a counterpart. */
export const kDiffSamplePath = fileURLToPath(new URL('diff_sample.json', import.meta.url));
export const sample = (): Results => readResults(readFileSync(kSamplePath, 'utf8'));

const summary = (median: number): NonNullable<Row['gpu_us']> => ({
  min: median * 0.8,
  p5: median * 0.9,
  median,
  p95: median * 1.1,
  p99: median * 1.2,
  max: median * 1.3,
});

const difference = (max: number): NonNullable<PictureError['linear']> => ({
  max_abs: max,
  p999_abs: max / 10,
  rmse: max / 100,
  relative_rmse: max / 100,
  psnr_db: max === 0 ? null : 60,
  pixels: 100,
  differing: max === 0 ? 0 : 5,
  nonfinite: 0,
});

export const errorOf = (max: number, flip: number): PictureError => ({
  skipped: null,
  exact: max === 0,
  view: 'first',
  views: 1,
  linear: difference(max),
  shown: difference(max),
  perceived: { above_1_255: 0, mssim: 1, flip },
  hdr_flip: flip,
  tile_edge_ratio: 1,
});

export const kNoError: PictureError = {
  skipped: 'too long',
  exact: null,
  view: null,
  views: null,
  linear: null,
  shown: null,
  perceived: null,
  hdr_flip: null,
  tile_edge_ratio: null,
};

/** A row of `median` ms on every clock. */
export const rowOf = (label: string, median: number, changes: Partial<Row> = {}): Row => ({
  label,
  series: 'clustered_deferred',
  value: 0,
  workload: 'a picture',
  settings: { renderer: 'clustered_deferred', gbuffer: { normal: 'oct16', position: 'depth' } },
  scaled_to: null,
  command: `froxel render # ${label}`,
  frames: 100,
  passes: [{ name: 'lighting', gpu_us: summary(median * 500) }],
  memory_bytes: { 'G-buffer': 2e6 },
  gpu_us: summary(median * 1000),
  frame_us: summary(median * 1000),
  cpu_us: summary(median * 1000),
  host_us: summary(median * 1000),
  error_r1: errorOf(0, 0),
  error_r2: errorOf(0.01, 0.001),
  stream: null,
  note: null,
  ...changes,
});

export const sweepOf = (rows: readonly Row[], changes: Partial<Sweep> = {}): Sweep => ({
  name: 'light_count',
  title: 'Lights',
  variable: 'lights',
  unit: '',
  axis: 'log',
  about: '',
  rows,
  skipped: [],
  ...changes,
});

export const resultsOf = (sweeps: readonly Sweep[], changes: Partial<Results> = {}): Results => ({
  ...sample(),
  sweeps,
  published: [],
  ...changes,
});
