// Stacked bars, a row each under its series' heading: a frame's passes, or the device's memory by purpose.

import * as Plot from '@observablehq/plot';

import { nameAxis, nameMargin, xAxis, xGrid } from './axes';
import type { Row, Sweep } from './results';
import { words } from './words';

export interface Part {
  readonly series: string;
  readonly label: string;
  readonly name: string;
  readonly value: number;
}

const partsOf = (sweep: Sweep, amounts: (row: Row) => (readonly [string, number])[]): Part[] =>
  sweep.rows.flatMap((row) =>
    amounts(row).map(([name, value]) => ({ series: row.series, label: row.label, name, value })),
  );

/** Median ms of each pass of each row; nothing of a row with an unknown time, whose bar would look short. */
export const passParts = (sweep: Sweep): Part[] =>
  partsOf(sweep, ({ passes }) => {
    const known = passes.flatMap(({ name, gpu_us }) =>
      gpu_us ? [[name, gpu_us.median / 1000] as const] : [],
    );
    return known.length === passes.length ? known : [];
  });

/** The passes whose time some row does not know. */
export const unknownPasses = ({ rows }: Sweep): string[] => [
  ...new Set(
    rows.flatMap(({ passes }) => passes.flatMap(({ name, gpu_us }) => (gpu_us ? [] : name))),
  ),
];

/** Megabytes of each purpose of each row. */
export const memoryParts = (sweep: Sweep): Part[] =>
  partsOf(sweep, ({ memory_bytes }) =>
    Object.entries(memory_bytes).map(([name, bytes]) => [name, bytes / 1e6]),
  );

const barOf = ({ series, label }: Part): string => `${series}\n${label}`;

/** Each bar's parts as percent of it. */
export function shares(parts: readonly Part[]): Part[] {
  const sums = new Map<string, number>();
  for (const part of parts) sums.set(barOf(part), (sums.get(barOf(part)) ?? 0) + part.value);
  return parts.map((part) => {
    const sum = sums.get(barOf(part)) ?? 0;
    return { ...part, value: sum > 0 ? (100 * part.value) / sum : 0 };
  });
}

/** The lines of the plot from the top: a heading before each series' bars, unless they need none. */
export function linesOf(
  parts: readonly Part[],
): { key: string; heading: string | null; label: string }[] {
  const names = [...new Set(parts.map(({ series }) => series))];
  return names.flatMap((series) => {
    const own = parts.filter((part) => part.series === series);
    const bars = [...new Map(own.map((part) => [barOf(part), part.label]))];
    const lines = bars.map(([key, label]) => ({ key, heading: null, label: words(label) }));
    const plain = names.length === 1 || (bars.length === 1 && own[0]?.label === series);
    return plain ? lines : [{ key: series, heading: words(series), label: '' }, ...lines];
  });
}

export interface BarOptions {
  readonly width: number;
  readonly axis: string;
  readonly unit: string;
  readonly colours: ReadonlyMap<string, string>;
}

export function partBars(
  parts: readonly Part[],
  { width, axis, unit, colours }: BarOptions,
): SVGElement {
  const lines = linesOf(parts);
  const labels = new Map(lines.map(({ key, label }) => [key, label]));
  return Plot.plot({
    width,
    height: lines.length * 22 + 48,
    marginTop: 4,
    marginLeft: nameMargin([...labels.values()], width),
    marginRight: 24,
    marginBottom: 40,
    y: { type: 'band', domain: lines.map(({ key }) => key), padding: 0.25, label: null },
    marks: [
      xGrid(),
      ...xAxis(axis),
      nameAxis((key) => labels.get(key) ?? ''),
      Plot.text(
        lines.filter(({ heading }) => heading !== null),
        {
          y: 'key',
          text: 'heading',
          frameAnchor: 'left',
          textAnchor: 'start',
          dx: 2,
          dy: 3,
          fontWeight: 600,
        },
      ),
      Plot.barX(parts, {
        y: barOf,
        x: 'value',
        fill: (d: Part) => colours.get(d.name) ?? 'var(--muted)',
        z: 'name',
        insetRight: 0.5,
        tip: true,
        title: (d: Part) =>
          `${words(d.series)}, ${d.label}\n${d.name}: ${Number(d.value.toPrecision(3))} ${unit}`,
      }),
    ],
  }) as SVGElement;
}
