// Speed against error: the plots of both metrics for one workload, and their fronts as tables.

import { make } from '../src/core/dom';
import { errorPlot, errorPoints, kMetrics, workloadsOf, type ErrorPoint } from './error_plot';
import { seriesColours, shapesOf, type Shape } from './marks';
import { paretoFront } from './pareto';
import type { Clock, Results, Row } from './results';
import { layoutOf } from './results';
import { card, place, type Section } from './sections';
import { legend, table } from './table';
import { errorText, kNone, msText, spreadText } from './text';
import { words } from './words';

/** A row on the front of either metric, with its number there. */
interface FrontRow {
  readonly point: ErrorPoint;
  readonly numbers: readonly (number | null)[]; // by metric, from 1
}

/** The rows of both fronts, the fastest first. */
export function frontRows(fronts: readonly (readonly ErrorPoint[])[]): FrontRow[] {
  const points = new Map<Row, ErrorPoint>();
  for (const point of fronts.flat()) points.set(point.row, point);
  return [...points.values()]
    .sort((a, b) => a.x - b.x)
    .map((point) => ({
      point,
      numbers: fronts.map((front) => {
        const index = front.findIndex(({ row }) => row === point.row);
        return index < 0 ? null : index + 1;
      }),
    }));
}

const kHeads = ['# (largest)', '# (FLIP)'] as const;

const frontTable = (rows: readonly FrontRow[]): HTMLElement =>
  table(
    rows,
    [
      { head: 'row', text: ({ point }) => point.row.label },
      { head: 'sweep', text: ({ point }) => words(point.sweep.name) },
      ...kHeads.map((head, index) => ({
        head,
        title: 'Its number in the plot above',
        text: ({ numbers }: FrontRow) => String(numbers[index] ?? kNone),
        number: true,
      })),
      { head: 'renderer', text: ({ point }) => words(point.row.settings.renderer) },
      { head: 'G-buffer', text: ({ point }) => layoutOf(point.row) },
      { head: 'median, ms', text: ({ point }) => msText(point.x), number: true },
      { head: 'p5 … p95', text: ({ point }) => spreadText(point.time), number: true },
      ...kMetrics.map((metric) => ({
        head: metric.short,
        text: ({ point }: FrontRow) => errorText(metric.of(point.row)),
        number: true,
      })),
    ],
    ({ point }) => point.row.command,
  );

const pointLegend = (
  colours: ReadonlyMap<string, string>,
  shapes: ReadonlyMap<string, Shape>,
): HTMLElement =>
  legend([
    ...[...colours].map(([name, colour]) => ({ name: words(name), colour })),
    ...[...shapes].map(([name, { path }]) => ({ name, colour: 'var(--muted)', symbol: path })),
  ]);

export function errorSection(results: Results, usual: Clock): Section {
  const section = card(
    'speed-against-error',
    'Speed against error',
    'Points to the left are faster, points further down are closer to the double-precision reference (R2). The line joins the settings that no other setting beats in both; the table lists them. Points are rows of any sweep that draw the same picture.',
  );
  const pick = make('select');
  pick.setAttribute('aria-label', 'Picture drawn');
  for (const { name, rows } of workloadsOf(results.sweeps, usual)) {
    const option = make('option', `${name} (${rows} rows)`);
    option.value = name;
    pick.append(option);
  }
  const key = make('div');
  const blocks = kMetrics.map((metric) => {
    const block = make('div', '', 'metric');
    const holder = make('div', '', 'plot');
    block.append(make('h3', metric.name), holder);
    return { metric, block, holder };
  });
  const figures = make('div');
  const pair = make('div', '', 'pair');
  pair.append(...blocks.map(({ block }) => block));
  if (pick.options.length === 0) {
    section.append(make('p', 'No row has both a time and an error.', 'faint'));
  } else {
    section.append(pick, key, pair, make('h3', 'The fronts’ rows'), figures);
  }
  let clock = usual;
  const draw = (): void => {
    if (pick.options.length === 0) return;
    const all = kMetrics.map((metric) => errorPoints(results.sweeps, pick.value, metric, clock));
    const rows = all.flat();
    const colours = seriesColours(rows.map(({ row }) => row.settings.renderer));
    const shapes = shapesOf(rows.map(({ row }) => layoutOf(row)));
    key.replaceChildren(pointLegend(colours, shapes));
    for (const [index, { metric, holder }] of blocks.entries()) {
      const points = all[index] ?? [];
      place(holder, (width) =>
        points.length > 0 ? errorPlot(points, metric, { clock, width, colours, shapes }) : null,
      );
    }
    figures.replaceChildren(frontTable(frontRows(all.map((points) => paretoFront(points)))));
  };
  pick.addEventListener('change', draw);
  return {
    id: section.id,
    title: 'Speed against error',
    element: section,
    draw: (next) => {
      clock = next;
      draw();
    },
  };
}
