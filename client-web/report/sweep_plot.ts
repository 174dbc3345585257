// A sweep's plot: time against what varies, a line a series, whiskers from the 5th to the 95th
// percentile, and others' published figures as hollow marks.

import * as Plot from '@observablehq/plot';

import { kDiamond } from './marks';
import type { Clock, Published, Sweep, Summary } from './results';
import { timeMs } from './results';
import { apart, logAxis, shortNumber, spansDecades } from './scales';
import { kClockNames, msText, words } from './text';

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

const tipOf = ({ label, series, time }: Timed): string =>
  `${words(series)}, ${label}\n${msText(time.median)} ms (${msText(time.p5)} to ${msText(time.p95)})`;

/** The y axis of times in ms: logarithmic where they span decades, else from 0. */
function timeScale(times: readonly number[]): { scale: Plot.ScaleOptions; ticks: number[] | undefined } {
  if (!spansDecades(times)) {
    return { scale: { domain: [0, Math.max(...times, 1e-3) * 1.05] }, ticks: undefined };
  }
  const axis = logAxis(times);
  return { scale: { type: 'log', domain: [...axis.domain] }, ticks: [...axis.ticks] };
}

/** Values on the x axis whose labels have room. */
function legibleTicks(values: readonly number[], at: (value: number) => number, width: number): number[] {
  const distinct = [...new Set(values)].sort((a, b) => a - b);
  const [low, high] = [at(distinct[0] ?? 0), at(distinct.at(-1) ?? 1)];
  const positions = distinct.map((value) => ((at(value) - low) / (high - low || 1)) * width);
  return apart(positions, 46).flatMap((index) => distinct[index] ?? []);
}

function valuePlot(sweep: Sweep, rows: readonly Timed[], options: SweepPlotOptions): SVGElement {
  const references = referencesOf(sweep, options.published);
  const values = [...rows, ...references].map(({ value }) => value);
  const times = [
    ...rows.flatMap(({ time }) => [time.p5, time.p95]),
    ...references.map(({ ms }) => ms),
  ];
  const isLog = sweep.axis === 'log';
  const axis = logAxis(values);
  const x = isLog ? axis.place : (value: number): number => value;
  const margin = { marginLeft: 52, marginRight: 18 };
  const room = options.width - margin.marginLeft - margin.marginRight;
  const ticks = legibleTicks(values, (value) => (isLog ? axis.share(value) : value), room);
  // Zero stands on the axis' floor, not to scale: no line leads there.
  const onScale = ({ value }: { value: number }): boolean => !isLog || value > 0;
  const y = timeScale(times);
  const colour = ({ series }: { series: string }): string => options.colours.get(series) ?? 'var(--muted)';
  return Plot.plot({
    width: options.width,
    height: Math.min(420, Math.max(260, options.width * 0.5)),
    ...margin,
    marginTop: 32,
    marginBottom: 42,
    x: {
      ...(isLog ? { type: 'log' as const, domain: [...axis.domain] } : {}),
      label: null,
      inset: 12,
    },
    y: y.scale,
    marks: [
      Plot.gridY({ ...(y.ticks ? { ticks: y.ticks } : { tickSpacing: 40 }), className: 'grid' }),
      Plot.axisY({
        ...(y.ticks ? { ticks: y.ticks } : { tickSpacing: 40 }),
        ...(y.ticks ? { text: shortNumber } : { tickFormat: shortNumber }),
        label: `${kClockNames[options.clock]}, ms`,
        labelArrow: 'none',
        tickSize: 0,
      }),
      Plot.axisX({
        ticks: ticks.map(x),
        text: (tick: number) => (isLog ? axis.label(tick) : shortNumber(tick)),
        label: sweep.unit && sweep.unit !== sweep.variable ? `${words(sweep.variable)}, ${sweep.unit}` : words(sweep.variable),
        labelArrow: 'none',
        labelAnchor: 'center',
        tickSize: 4,
      }),
      Plot.line(references.filter(onScale), {
        sort: 'value',
        x: (d: Reference) => x(d.value),
        y: 'ms',
        z: (d: Reference) => `${d.line} ${d.series}`,
        stroke: colour,
        strokeWidth: 1,
        strokeOpacity: 0.55,
        strokeDasharray: '3 4',
      }),
      Plot.dot(references, {
        x: (d: Reference) => x(d.value),
        y: 'ms',
        stroke: colour,
        strokeOpacity: 0.8,
        symbol: kDiamond,
        r: 3.5,
        fill: 'var(--surface-solid)',
      }),
      Plot.line(rows.filter(onScale), { sort: 'value', x: (d: Timed) => x(d.value), y: (d: Timed) => d.time.median, z: 'series', stroke: colour, strokeWidth: 2 }),
      Plot.ruleX(rows, {
        x: (d: Timed) => x(d.value),
        y1: (d: Timed) => d.time.p5,
        y2: (d: Timed) => d.time.p95,
        stroke: colour,
        strokeWidth: 1.5,
        marker: 'tick',
      }),
      Plot.dot(rows, { x: (d: Timed) => x(d.value), y: (d: Timed) => d.time.median, fill: colour, r: 3.5 }),
      Plot.tip(
        [
          ...rows.map((row) => ({ x: x(row.value), y: row.time.median, title: tipOf(row) })),
          ...references.map((d) => ({
            x: x(d.value),
            y: d.ms,
            title: `${words(d.series)}, ${shortNumber(d.value)}: ${d.printed} = ${msText(d.ms)} ms\npublished: ${d.line}`,
          })),
        ],
        Plot.pointer({ x: 'x', y: 'y', title: 'title' }),
      ),
    ],
  }) as SVGElement;
}

/** Rows without a number stand one below the other. */
function categoryPlot(rows: readonly Timed[], options: SweepPlotOptions): SVGElement {
  const several = new Set(rows.map(({ series }) => series)).size > 1;
  const name = (row: Timed): string =>
    several && row.label !== row.series ? `${row.label} · ${words(row.series)}` : words(row.label);
  const longest = Math.max(...rows.map((row) => name(row).length));
  const marginLeft = Math.min(longest * 6.4 + 14, options.width * 0.45);
  const colour = ({ series }: Timed): string => options.colours.get(series) ?? 'var(--muted)';
  return Plot.plot({
    width: options.width,
    height: rows.length * 26 + 48,
    marginTop: 4,
    marginLeft,
    marginRight: 24,
    marginBottom: 40,
    x: { domain: [0, Math.max(...rows.map(({ time }) => time.p95)) * 1.05] },
    y: { type: 'band', domain: rows.map(name), label: null },
    marks: [
      Plot.gridX({ tickSpacing: 70, className: 'grid' }),
      Plot.axisX({ tickSpacing: 70, tickFormat: shortNumber, tickSize: 0, label: `${kClockNames[options.clock]}, ms`, labelArrow: 'none', labelAnchor: 'center' }),
      Plot.axisY({ tickSize: 0, label: null, lineWidth: marginLeft / 11, textOverflow: 'ellipsis' }),
      Plot.ruleY(rows, { y: name, x1: 0, x2: (d: Timed) => d.time.median, stroke: colour, strokeOpacity: 0.25, strokeWidth: 2 }),
      Plot.ruleY(rows, { y: name, x1: (d: Timed) => d.time.p5, x2: (d: Timed) => d.time.p95, stroke: colour, strokeWidth: 1.5, marker: 'tick' }),
      Plot.dot(rows, { y: name, x: (d: Timed) => d.time.median, fill: colour, r: 4.5 }),
      Plot.tip(rows, Plot.pointerY({ y: name, x: (d: Timed) => d.time.median, title: tipOf })),
    ],
  }) as SVGElement;
}

/** The plot, or null where no row has this clock. */
export function sweepPlot(sweep: Sweep, options: SweepPlotOptions): SVGElement | null {
  const rows = timedRows(sweep, options.clock);
  if (rows.length === 0) return null;
  return sweep.axis === 'category' ? categoryPlot(rows, options) : valuePlot(sweep, rows, options);
}
