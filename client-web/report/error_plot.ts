// Speed against error: a point a row, the front of those that no other beats, exact rows on a floor line.

import * as Plot from '@observablehq/plot';

import { paretoFront } from './pareto';
import type { Clock, Row, Summary, Sweep } from './results';
import { layoutOf, timeMs } from './results';
import { clear, logAxis, type LogAxis } from './scales';
import { kMargin, xAxis, xGrid, yAxis } from './axes';
import { kDot, type Shape } from './marks';
import { errorText, kClockNames, msText } from './text';
import { words } from './words';

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
  {
    name: 'LDR-FLIP',
    short: 'FLIP',
    axis: 'mean LDR-FLIP',
    of: (row) => row.error_r2.perceived?.flip ?? null,
  },
];

export interface ErrorPoint {
  readonly x: number; // ms
  readonly y: number; // error
  readonly time: Summary;
  readonly sweep: Sweep;
  readonly row: Row;
}

/** Rows that draw a picture of their own: those of the stream encode one of others. */
const isDrawn = (row: Row): boolean => row.stream === null;

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
      return isDrawn(row) && row.workload === workload && time && y !== null && time.median > 0
        ? [{ x: time.median, y, time, sweep, row }]
        : [];
    }),
  );

/** Workloads by how many rows may be compared, most first. */
export function workloadsOf(
  sweeps: readonly Sweep[],
  clock: Clock,
): { name: string; rows: number }[] {
  const counts = new Map<string, number>();
  for (const { rows } of sweeps) {
    for (const row of rows) {
      const usable =
        isDrawn(row) && row[clock] !== null && kMetrics.some((metric) => metric.of(row) !== null);
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

/** What the plot's parts share. */
interface Frame {
  readonly x: LogAxis;
  readonly y: LogAxis;
  readonly height: number;
  readonly place: (point: ErrorPoint) => number;
  readonly colour: (point: ErrorPoint) => string;
}

/** The line of exact rows, with its name. */
const floorMarks = ({ y: { floor } }: Frame): Plot.Markish[] =>
  floor === null
    ? []
    : [
        Plot.ruleY([floor], { stroke: 'var(--exact)', strokeWidth: 1.5, strokeDasharray: '6 4' }),
        Plot.text(['exact: error 0'], {
          y: () => floor,
          frameAnchor: 'right',
          textAnchor: 'end',
          dy: 10,
          fill: 'var(--exact)',
        }),
      ];

/** Points with whiskers; those of the front last, since they may lie under others, and ringed. */
function pointMarks(
  points: readonly ErrorPoint[],
  front: ReadonlySet<ErrorPoint>,
  { x, place, colour }: Frame,
  shapes: ReadonlyMap<string, Shape>,
): Plot.Markish[] {
  const ordered = [...points].sort((a, b) => Number(front.has(a)) - Number(front.has(b)));
  return [
    Plot.ruleY(points, {
      y: place,
      x1: (d: ErrorPoint) => x.place(d.time.p5),
      x2: (d: ErrorPoint) => x.place(d.time.p95),
      stroke: colour,
      strokeOpacity: 0.7,
      marker: 'tick',
    }),
    ...ordered.map((point) =>
      Plot.dot([point], {
        x: 'x',
        y: place,
        fill: colour,
        symbol: shapes.get(layoutOf(point.row)) ?? kDot,
        r: 5,
        stroke: front.has(point) ? 'var(--front)' : 'var(--surface-solid)',
        strokeWidth: front.has(point) ? 1.5 : 1,
      }),
    ),
  ];
}

/** The front's line, and its points' numbers where they have room: nothing lies below and left of it. */
function frontMarks(
  front: readonly ErrorPoint[],
  { x, y, height, place }: Frame,
  width: number,
): Plot.Markish[] {
  const [across, along] = [width - 96, height - 106]; // about what margins and insets leave
  const free = clear(
    front.map((point) => ({ x: x.share(point.x) * across, y: y.share(point.y) * along })),
    15,
  );
  const numbers = front.flatMap((point, index) =>
    free[index] ? [{ point, text: String(index + 1) }] : [],
  );
  return [
    Plot.line(front, {
      x: 'x',
      y: place,
      curve: 'step-after',
      stroke: 'var(--front)',
      strokeWidth: 1.5,
    }),
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
  ];
}

const tipOf = ({ row, sweep, x, y, time }: ErrorPoint): string =>
  [
    `${row.label} (${sweep.title})`,
    `${words(row.settings.renderer)}, ${layoutOf(row)}`,
    `${msText(x)} ms (${msText(time.p5)} to ${msText(time.p95)}), error ${errorText(y)}`,
  ].join('\n');

export function errorPlot(
  points: readonly ErrorPoint[],
  metric: Metric,
  { clock, width, colours, shapes }: ErrorPlotOptions,
): SVGElement {
  const front = paretoFront(points);
  const x = logAxis(points.flatMap(({ time }) => [time.p5, time.p95]));
  const y = logAxis(points.map((point) => point.y));
  const frame: Frame = {
    x,
    y,
    height: Math.min(440, Math.max(300, width * 0.75)),
    place: (point) => y.place(point.y),
    colour: ({ row }) => colours.get(row.settings.renderer) ?? 'var(--muted)',
  };
  return Plot.plot({
    width,
    height: frame.height,
    ...kMargin,
    x: { type: 'log', domain: [...x.domain], inset: 12 },
    y: {
      type: 'log',
      domain: [...y.domain],
      insetTop: 10,
      insetBottom: y.floor === null ? 16 : 22,
    },
    marks: [
      xGrid(x.ticks),
      ...yAxis(metric.axis, y.ticks, y.label),
      ...xAxis(`${kClockNames[clock]}, ms`, x.ticks),
      ...floorMarks(frame),
      ...frontMarks(front, frame, width),
      ...pointMarks(points, new Set(front), frame, shapes),
      Plot.tip(points, Plot.pointer({ x: 'x', y: frame.place, title: tipOf })),
    ],
  }) as SVGElement;
}
