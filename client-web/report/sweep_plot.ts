// A sweep's plot: time against what varies, a line a series, whiskers from the 5th to the 95th
// percentile, and others' published figures as hollow marks.

import * as Plot from '@observablehq/plot';

import { kMargin, nameAxis, nameMargin, xAxis, xGrid, yAxis } from './axes';
import { shapesOf, type Shape } from './marks';
import type { Clock, Published, Summary, Sweep } from './results';
import { timeMs } from './results';
import { apart, logAxis, shortNumber, spansDecades } from './scales';
import { kClockNames, msText } from './text';
import { words } from './words';

export interface SweepPlotOptions {
  readonly clock: Clock;
  readonly width: number;
  readonly colours: ReadonlyMap<string, string>;
  readonly published: readonly Published[];
}

interface Timed {
  readonly label: string;
  readonly series: string;
  readonly value: number;
  readonly time: Summary;
}

interface Reference {
  readonly series: string;
  readonly line: string; // whose, on what
  readonly value: number;
  readonly ms: number;
  readonly printed: string;
}

export const timedRows = (sweep: Sweep, clock: Clock): Timed[] =>
  sweep.rows.flatMap((row) => {
    const time = timeMs(row, clock);
    return time ? [{ label: row.label, series: row.series, value: row.value, time }] : [];
  });

/** Published figures that can stand in a sweep's plot: of what varies in it, in milliseconds. */
export const referencesOf = (sweep: Sweep, published: readonly Published[]): Reference[] =>
  sweep.axis === 'category'
    ? []
    : published
        .filter((line) => line.sweep === sweep.name && line.variable === sweep.variable)
        .flatMap(({ series, source, hardware, rows }) =>
          rows.flatMap(({ value, ms, published: printed }) =>
            ms === null ? [] : [{ series, line: `${source}, ${hardware}`, value, ms, printed }],
          ),
        );

/** A hollow mark for each of those who published. */
export const referenceShapes = (references: readonly Reference[]): Map<string, Shape> =>
  shapesOf(references.map(({ line }) => line));

const tipOf = ({ label, series, time }: Timed): string =>
  `${words(series)}, ${label}\n${msText(time.median)} ms (${msText(time.p5)} to ${msText(time.p95)})`;

const referenceTipOf = ({ series, value, printed, ms, line }: Reference): string =>
  `${words(series)}, ${shortNumber(value)}: ${printed} = ${msText(ms)} ms\npublished: ${line}`;

const medianOf = ({ time }: Timed): number => time.median;

/** Where values stand on the x axis, and which of them its ticks name. */
interface ValueAxis {
  readonly place: (d: { value: number }) => number;
  readonly options: Plot.ScaleOptions;
  readonly ticks: readonly number[];
  readonly text: (tick: number) => string;
  /** Zero stands on a logarithmic axis' floor, not to scale: no line leads there. */
  readonly onScale: (d: { value: number }) => boolean;
}

function valueAxis({ axis }: Sweep, values: readonly number[], room: number): ValueAxis {
  const scale = logAxis(values);
  const isLog = axis === 'log';
  const distinct = [...new Set(values)].sort((a, b) => a - b);
  const [least, most] = [distinct[0] ?? 0, distinct.at(-1) ?? 1];
  const share = (value: number): number =>
    isLog ? scale.share(value) : (value - least) / (most - least || 1);
  const named = apart(
    distinct.map((value) => share(value) * room),
    46,
  );
  const at = (value: number): number => (isLog ? scale.place(value) : value);
  return {
    place: ({ value }) => at(value),
    options: { inset: 12, ...(isLog ? { type: 'log', domain: [...scale.domain] } : {}) },
    ticks: named.map((index) => at(distinct[index] ?? 0)),
    text: isLog ? scale.label : shortNumber,
    onScale: ({ value }) => !isLog || value > 0,
  };
}

/** The y axis of times in ms: logarithmic where they span decades, else from 0. */
function timeAxis(times: readonly number[]): {
  options: Plot.ScaleOptions;
  ticks?: readonly number[];
} {
  if (!spansDecades(times)) return { options: { domain: [0, Math.max(...times, 1e-3) * 1.05] } };
  const axis = logAxis(times);
  return { options: { type: 'log', domain: [...axis.domain] }, ticks: axis.ticks };
}

type Colour = (d: { series: string }) => string;

const referenceMarks = (
  references: readonly Reference[],
  x: ValueAxis,
  stroke: Colour,
): Plot.Markish[] => [
  Plot.line(references.filter(x.onScale), {
    x: x.place,
    y: 'ms',
    z: (d: Reference) => `${d.line} ${d.series}`,
    sort: 'value',
    stroke,
    strokeWidth: 1,
    strokeOpacity: 0.55,
    strokeDasharray: '3 4',
  }),
  ...[...referenceShapes(references)].map(([name, shape]) =>
    Plot.dot(
      references.filter(({ line }) => line === name),
      {
        x: x.place,
        y: 'ms',
        stroke,
        strokeOpacity: 0.8,
        symbol: shape,
        r: 3.5,
        fill: 'var(--surface-solid)',
      },
    ),
  ),
];

const rowMarks = (rows: readonly Timed[], x: ValueAxis, colour: Colour): Plot.Markish[] => [
  Plot.line(rows.filter(x.onScale), {
    x: x.place,
    y: medianOf,
    z: 'series',
    sort: 'value',
    stroke: colour,
    strokeWidth: 2,
  }),
  Plot.ruleX(rows, {
    x: x.place,
    y1: (d: Timed) => d.time.p5,
    y2: (d: Timed) => d.time.p95,
    stroke: colour,
    strokeWidth: 1.5,
    marker: 'tick',
  }),
  Plot.dot(rows, { x: x.place, y: medianOf, fill: colour, r: 3.5 }),
];

function valuePlot(sweep: Sweep, rows: readonly Timed[], options: SweepPlotOptions): SVGElement {
  const { width, clock, colours, published } = options;
  const references = referencesOf(sweep, published);
  const values = [...rows, ...references].map(({ value }) => value);
  const x = valueAxis(sweep, values, width - kMargin.marginLeft - kMargin.marginRight - 24);
  const y = timeAxis([
    ...rows.flatMap(({ time }) => [time.p5, time.p95]),
    ...references.map(({ ms }) => ms),
  ]);
  const colour: Colour = ({ series }) => colours.get(series) ?? 'var(--muted)';
  const unit = sweep.unit === '' || sweep.unit === sweep.variable ? '' : `, ${sweep.unit}`;
  const tips = [
    ...rows.map((row) => ({ x: x.place(row), y: row.time.median, title: tipOf(row) })),
    ...references.map((d) => ({ x: x.place(d), y: d.ms, title: referenceTipOf(d) })),
  ];
  return Plot.plot({
    width,
    height: Math.min(420, Math.max(260, width * 0.5)),
    ...kMargin,
    x: { label: null, ...x.options },
    y: y.options,
    marks: [
      ...yAxis(`${kClockNames[clock]}, ms`, y.ticks),
      ...xAxis(`${words(sweep.variable)}${unit}`, x.ticks, x.text),
      ...referenceMarks(references, x, colour),
      ...rowMarks(rows, x, colour),
      Plot.tip(tips, Plot.pointer({ x: 'x', y: 'y', title: 'title' })),
    ],
  }) as SVGElement;
}

/** Rows without a number stand one below the other. */
function categoryPlot(
  rows: readonly Timed[],
  { width, clock, colours }: SweepPlotOptions,
): SVGElement {
  const several = new Set(rows.map(({ series }) => series)).size > 1;
  const name = (row: Timed): string =>
    several && row.label !== row.series ? `${row.label} · ${words(row.series)}` : words(row.label);
  const names = rows.map(name);
  const stroke: Colour = ({ series }) => colours.get(series) ?? 'var(--muted)';
  const [low, high] = [(d: Timed): number => d.time.p5, (d: Timed): number => d.time.p95];
  return Plot.plot({
    width,
    height: rows.length * 26 + 48,
    marginTop: 4,
    marginLeft: nameMargin(names, width),
    marginRight: 24,
    marginBottom: 40,
    x: { domain: [0, Math.max(...rows.map(high)) * 1.05] },
    y: { type: 'band', domain: names, label: null },
    marks: [
      xGrid(),
      ...xAxis(`${kClockNames[clock]}, ms`),
      nameAxis((key) => key),
      Plot.ruleY(rows, {
        y: name,
        x1: 0,
        x2: medianOf,
        stroke,
        strokeOpacity: 0.25,
        strokeWidth: 2,
      }),
      Plot.ruleY(rows, { y: name, x1: low, x2: high, stroke, strokeWidth: 1.5, marker: 'tick' }),
      Plot.dot(rows, { y: name, x: medianOf, fill: stroke, r: 4.5 }),
      Plot.tip(rows, Plot.pointerY({ y: name, x: medianOf, title: tipOf })),
    ],
  }) as SVGElement;
}

/** The plot, or null where no row has this clock. */
export function sweepPlot(sweep: Sweep, options: SweepPlotOptions): SVGElement | null {
  const rows = timedRows(sweep, options.clock);
  if (rows.length === 0) return null;
  return sweep.axis === 'category' ? categoryPlot(rows, options) : valuePlot(sweep, rows, options);
}
