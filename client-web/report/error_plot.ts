// Speed against error: a point a row, the front of those that no other beats, exact rows on a floor line.

import * as Plot from '@observablehq/plot';

import { paretoFront } from './pareto';
import type { Clock, Row, Summary, Sweep } from './results';
import { layoutOf, timeMs } from './results';
import { clear, logAxis, shortNumber } from './scales';
import { kDot, type Shape } from './marks';
import { errorText, kClockNames, msText, words } from './text';

/** An error to plot: its name, its axis, and where a row has it (null: nowhere). */
export interface Metric {
  readonly name: string;
  readonly short: string; // for a table
  readonly axis: string;
  readonly of: (row: Row) => number | null;
}

export const kMetrics: readonly Metric[] = [
  {
    name: 'Largest error of a pixel',
    short: 'largest',
    axis: 'largest absolute error, linear radiance',
    of: (row) => row.error_r2.linear?.max_abs ?? null,
  },
  { name: 'LDR-FLIP', short: 'FLIP', axis: 'mean LDR-FLIP', of: (row) => row.error_r2.perceived?.flip ?? null },
];

export interface ErrorPoint {
  readonly x: number; // ms
  readonly y: number; // error
  readonly time: Summary;
  readonly sweep: Sweep;
  readonly row: Row;
}

/** Rows of one workload that have both a time and an error. */
export const errorPoints = (
  sweeps: readonly Sweep[],
  workload: string,
  metric: Metric,
  clock: Clock,
): ErrorPoint[] =>
  sweeps.flatMap((sweep) =>
    sweep.rows.flatMap((row) => {
      const time = timeMs(row, clock);
      const y = metric.of(row);
      return row.workload === workload && time && y !== null && time.median > 0
        ? [{ x: time.median, y, time, sweep, row }]
        : [];
    }),
  );

/** Workloads by how many rows may be compared, most first. */
export function workloadsOf(sweeps: readonly Sweep[], clock: Clock): { name: string; rows: number }[] {
  const counts = new Map<string, number>();
  for (const { rows } of sweeps) {
    for (const row of rows) {
      const usable = row[clock] !== null && kMetrics.some((metric) => metric.of(row) !== null);
      if (usable) counts.set(row.workload, (counts.get(row.workload) ?? 0) + 1);
    }
  }
  return [...counts]
    .map(([name, rows]) => ({ name, rows }))
    .sort((a, b) => b.rows - a.rows || a.name.localeCompare(b.name));
}

export interface ErrorPlotOptions {
  readonly clock: Clock;
  readonly width: number;
  readonly colours: ReadonlyMap<string, string>;
  readonly shapes: ReadonlyMap<string, Shape>;
}

export function errorPlot(points: readonly ErrorPoint[], metric: Metric, options: ErrorPlotOptions): SVGElement {
  const front = paretoFront(points);
  const x = logAxis(points.flatMap(({ time }) => [time.p5, time.p95]));
  const y = logAxis(points.map((point) => point.y));
  const margin = { marginLeft: 56, marginRight: 16 };
  const height = Math.min(440, Math.max(300, options.width * 0.75));
  const pixels = front.map((point) => ({ x: x.share(point.x) * (options.width - 96), y: y.share(point.y) * (height - 106) }));
  const free = clear(pixels, 15);
  const numbers = front.flatMap((point, index) => (free[index] ? [{ point, text: String(index + 1) }] : []));
  const colour = ({ row }: ErrorPoint): string => options.colours.get(row.settings.renderer) ?? 'var(--muted)';
  const shape = ({ row }: ErrorPoint): Shape => options.shapes.get(layoutOf(row)) ?? kDot;
  const onFront = new Set(front);
  const place = (point: ErrorPoint): number => y.place(point.y);
  return Plot.plot({
    width: options.width,
    height,
    ...margin,
    marginTop: 32,
    marginBottom: 42,
    x: { type: 'log', domain: [...x.domain], insetLeft: 12, insetRight: 12 },
    y: { type: 'log', domain: [...y.domain], insetTop: 10, insetBottom: y.floor === null ? 16 : 22 },
    marks: [
      Plot.gridY({ ticks: y.ticks.filter((tick) => tick !== y.floor), className: 'grid' }),
      Plot.gridX({ ticks: [...x.ticks], className: 'grid' }),
      Plot.axisY({ ticks: [...y.ticks], text: y.label, tickSize: 0, label: metric.axis, labelArrow: 'none' }),
      Plot.axisX({ ticks: [...x.ticks], text: shortNumber, tickSize: 4, label: `${kClockNames[options.clock]}, ms`, labelArrow: 'none', labelAnchor: 'center' }),
      ...(y.floor === null
        ? []
        : [
            Plot.ruleY([y.floor], { stroke: 'var(--exact)', strokeWidth: 1.5, strokeDasharray: '6 4' }),
            Plot.text([y.floor], { y: (d: number) => d, frameAnchor: 'right', text: () => 'exact: error 0', textAnchor: 'end', dy: 10, fill: 'var(--exact)' }),
          ]),
      Plot.line(front, { x: 'x', y: place, curve: 'step-after', stroke: 'var(--front)', strokeWidth: 1.5 }),
      Plot.ruleY(points, { y: place, x1: (d: ErrorPoint) => x.place(d.time.p5), x2: (d: ErrorPoint) => x.place(d.time.p95), stroke: colour, strokeOpacity: 0.7, marker: 'tick' }),
      // The front last, ringed: it may lie under others.
      ...[...points].sort((a, b) => Number(onFront.has(a)) - Number(onFront.has(b))).map((point) =>
        Plot.dot([point], {
          x: 'x',
          y: place,
          fill: colour,
          symbol: shape(point),
          r: 5,
          stroke: onFront.has(point) ? 'var(--front)' : 'var(--surface-solid)',
          strokeWidth: onFront.has(point) ? 1.5 : 1,
        }),
      ),
      Plot.text(numbers, {
        x: ({ point }: { point: ErrorPoint }) => point.x,
        y: ({ point }: { point: ErrorPoint }) => place(point),
        text: 'text',
        dx: -10,
        dy: 11,
        fontWeight: 600,
        fill: 'currentColor',
        stroke: 'var(--surface-solid)',
        strokeWidth: 3,
      }),
      Plot.tip(
        points,
        Plot.pointer({
          x: 'x',
          y: place,
          title: (d: ErrorPoint) =>
            `${d.row.label} (${d.sweep.title})\n${words(d.row.settings.renderer)}, ${layoutOf(d.row)}\n${msText(d.x)} ms (${msText(d.time.p5)} to ${msText(d.time.p95)}), error ${errorText(d.y)}`,
        }),
      ),
    ],
  }) as SVGElement;
}
