// Numbers and names as the report writes them.

import { ms } from '../src/core/format';
import type { Clock, PictureError, Results, Summary } from './results';

export const kNone = '–';

/** What the four clocks measure, for people. */
export const kClockNames: Readonly<Record<Clock, string>> = {
  gpu_us: 'GPU time',
  frame_us: 'frame time',
  cpu_us: 'CPU time',
  host_us: 'host time',
};
export const kClockWords: Readonly<Record<Clock, string>> = {
  gpu_us: 'from a frame’s first to its last timestamp on the device',
  frame_us: 'from submission to readable pixels',
  cpu_us: 'CPU time of all threads of the process; the most stable of the four on a CPU device',
  host_us: 'the host’s work until submission',
};

/** An error: 0 as 0, others with three digits. */
export function errorText(value: number | null | undefined): string {
  if (value === null || value === undefined) return kNone;
  if (value === 0) return '0';
  return Math.abs(value) >= 1e-3 ? String(Number(value.toPrecision(3))) : value.toExponential(1);
}

export const msText = (value: number | null | undefined): string => ms(value ?? null);

export const spreadText = (summary: Summary | null): string =>
  summary ? `${ms(summary.p5)} … ${ms(summary.p95)}` : kNone;

/** PSNR in dB; `equal` where pictures are. */
export function psnrText(error: PictureError): string {
  if (!error.shown) return kNone;
  if (error.shown.psnr_db !== null) return error.shown.psnr_db.toFixed(1);
  return error.shown.differing === 0 ? 'equal' : kNone;
}

export function factorText(value: number | null): string {
  if (value === null) return kNone;
  return `${value < 9.95 ? value.toFixed(2) : value.toFixed(value < 99.5 ? 1 : 0)}×`;
}

export function durationText(seconds: number): string {
  if (seconds < 100) return `${Number(seconds.toPrecision(2))} s`;
  const minutes = Math.round(seconds / 60);
  return minutes < 100 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/** Times on a CPU device are CPU times, unless a run has none; elsewhere GPU times. */
export function usualClock(results: Results): Clock {
  const has = (clock: Clock): boolean =>
    results.sweeps.some(({ rows }) => rows.some((row) => row[clock] !== null));
  if (results.device.kind === 'cpu' && has('cpu_us')) return 'cpu_us';
  return has('gpu_us') ? 'gpu_us' : 'frame_us';
}
