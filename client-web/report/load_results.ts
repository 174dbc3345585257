// The JSON of `froxel load`, schema froxel.load.v2 (server/app/load_report.h), as far as its report reads it.

import { readReport } from './read';

export const kLoadSchema = 'froxel.load.v2';

export interface Times {
  readonly count: number;
  readonly median: number;
  readonly p95: number;
  readonly p99: number;
  readonly max: number;
}

export interface Figures {
  readonly frames: number;
  readonly frames_per_s: number;
  readonly latency_ms: Times | null;
  readonly reaction_ms: Times | null;
  readonly age_ms: Times | null;
  readonly received_bytes_per_s: number;
  readonly server_dropped: number;
  readonly client_dropped: number;
  readonly errors: number;
}

export interface LoadViewer extends Figures {
  readonly failure: string | null;
  readonly refused: boolean;
  readonly first_frame_ms: number | null;
  readonly stall_ms: number;
}

/** Of one second; server/app/load_series.h says what each figure is. */
export interface LoadSecond {
  readonly elapsed_s: number;
  readonly viewers: number;
  readonly joining: number;
  readonly refused: number;
  readonly failed: number;
  readonly frames_per_s: number;
  readonly mbit_per_s: number;
  readonly latency_p50_ms: number | null;
  readonly latency_p95_ms: number | null;
  readonly latency_p99_ms: number | null;
  readonly longest_wait_ms: number | null;
}

export interface Served {
  readonly viewers: number;
  readonly server_version: string;
  readonly device: string;
  readonly scene: string;
  readonly triangles: number;
  readonly size: { readonly width_px: number; readonly height_px: number };
  readonly lights: number;
  readonly codec: string;
}

export interface Outcome {
  readonly requirement: string;
  readonly measured: number | null;
  readonly held: boolean;
}

export interface LoadResults {
  readonly schema: string;
  readonly url: string;
  readonly scripts: readonly { readonly name: string; readonly share: number }[];
  readonly viewers: number;
  readonly measured_s: number;
  readonly stopped: boolean;
  readonly ended_early: boolean;
  readonly served: readonly Served[];
  readonly requirements: readonly Outcome[];
  readonly broken: string | null;
  readonly all: Figures;
  readonly each: readonly LoadViewer[];
  readonly series: readonly LoadSecond[];
}

export const readLoad = (text: string): LoadResults => readReport(text, kLoadSchema, 'load');
