// The JSON of `froxel bench`, schema froxel.bench.v1 (tests/bench/results/README.md), as far as the report
// reads it. Numbers that JSON cannot hold (NaN, infinity) come as null.

import { readReport } from './read';
import { words } from './words';

export const kSchema = 'froxel.bench.v1';

export interface Summary {
  readonly min: number;
  readonly p5: number;
  readonly median: number;
  readonly p95: number;
  readonly p99: number;
  readonly max: number;
}

export interface Difference {
  readonly max_abs: number | null;
  readonly p999_abs: number | null;
  readonly rmse: number | null;
  readonly relative_rmse: number | null;
  readonly psnr_db: number | null;
  readonly pixels: number;
  readonly differing: number;
  readonly nonfinite: number;
}

export interface Perceived {
  readonly above_1_255: number;
  readonly mssim: number | null;
  readonly flip: number | null;
}

/** With a reason in `skipped` everything else is null. */
export interface PictureError {
  readonly skipped: string | null;
  readonly exact: boolean | null;
  readonly view: string | null;
  readonly views: number | null;
  readonly linear: Difference | null;
  readonly shown: Difference | null;
  readonly perceived: Perceived | null;
  readonly hdr_flip: number | null;
  readonly tile_edge_ratio: number | null;
}

export interface StreamError {
  readonly quality: number;
  readonly chroma: string;
  readonly bytes: number;
  readonly bits_per_pixel: number;
  readonly encode_us: Summary;
  readonly shown: Difference;
  readonly perceived: Perceived;
}

export interface Settings {
  readonly renderer: string;
  readonly gbuffer: { readonly normal: string; readonly position: string };
}

export interface Pass {
  readonly name: string;
  readonly gpu_us: Summary | null; // null: the driver wrote no timestamps
}

export const kClocks = ['gpu_us', 'frame_us', 'cpu_us', 'host_us'] as const;
export type Clock = (typeof kClocks)[number];

export type Row = Readonly<Record<Clock, Summary | null>> & {
  readonly label: string;
  readonly series: string;
  readonly value: number;
  readonly workload: string;
  readonly settings: Settings;
  readonly scaled_to: readonly [number, number] | null;
  readonly command: string;
  readonly frames: number;
  readonly passes: readonly Pass[];
  readonly memory_bytes: Readonly<Record<string, number>>;
  readonly error_r1: PictureError;
  readonly error_r2: PictureError;
  readonly stream: StreamError | null;
  readonly note: string | null;
};

export interface Skipped {
  readonly label: string;
  readonly series: string;
  readonly value: number;
  readonly command: string;
  readonly reason: string;
}

export interface Sweep {
  readonly name: string;
  readonly title: string;
  readonly variable: string;
  readonly unit: string;
  readonly axis: 'log' | 'linear' | 'category';
  readonly about: string;
  readonly rows: readonly Row[];
  readonly skipped: readonly Skipped[];
}

export interface PublishedRow {
  readonly value: number;
  readonly ms: number | null;
  readonly published: string;
}

export interface Published {
  readonly source: string;
  readonly hardware: string;
  readonly sweep: string;
  readonly series: string;
  readonly variable: string;
  readonly note: string;
  readonly rows: readonly PublishedRow[];
}

export interface Results {
  readonly schema: string;
  readonly froxel: string;
  readonly date: string;
  readonly complete: boolean;
  readonly elapsed_s: number;
  readonly device: {
    readonly name: string;
    readonly driver: string;
    readonly kind: string;
    readonly vulkan: string;
  };
  readonly host: { readonly cpu: string; readonly threads: number };
  readonly build: { readonly type: string; readonly compiler: string };
  readonly scene: { readonly source: string; readonly name: string; readonly triangles: number };
  readonly method: Readonly<Record<string, unknown>>;
  readonly views: readonly { readonly name: string; readonly time_s: number }[];
  readonly sweeps: readonly Sweep[];
  readonly published: readonly Published[];
}

export const readResults = (text: string): Results => readReport(text, kSchema, 'bench');

/** What a row's points are marked by: how the G-buffer is laid out, where there is one. */
export function layoutOf({ settings }: Row): string {
  const forward = settings.renderer === 'naive' || settings.renderer === 'forward_plus';
  return forward
    ? 'no G-buffer'
    : words(`${settings.gbuffer.normal}, ${settings.gbuffer.position}`);
}

/** Times of one row in milliseconds; null where the clock does not apply. */
export function timeMs(row: Row, clock: Clock): Summary | null {
  const us = row[clock];
  if (!us) return null;
  return {
    min: us.min / 1000,
    p5: us.p5 / 1000,
    median: us.median / 1000,
    p95: us.p95 / 1000,
    p99: us.p99 / 1000,
    max: us.max / 1000,
  };
}

/** How many times as fast as the fastest `naive` way to the same picture in the sweep; null without one. */
export function speedUp(row: Row, sweep: Sweep, clock: Clock): number | null {
  const own = row[clock]?.median;
  const naive = sweep.rows.flatMap((other) => {
    const same = other.value === row.value && other.workload === row.workload;
    return same && other.settings.renderer === 'naive' ? (other[clock]?.median ?? []) : [];
  });
  const isNaive = row.settings.renderer === 'naive';
  return isNaive || !own || naive.length === 0 ? null : Math.min(...naive) / own;
}
