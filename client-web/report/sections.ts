// The report's sections: each an element that can draw its plots anew for a clock and a width.

import { make } from '../src/core/dom';
import { bytes, count } from '../src/core/format';
import { kDot, partColours, seriesColours } from './marks';
import { memoryParts, partBars, passParts, shares, unknownPasses, type Part } from './part_bars';
import type { Clock, Published, PictureError, Results, Row, Skipped, Sweep } from './results';
import { speedUp, timeMs } from './results';
import { shortNumber } from './scales';
import { streamPlot, streamTable } from './stream_plot';
import { referenceShapes, referencesOf, sweepPlot } from './sweep_plot';
import { commandLines, legend, table, type Column } from './table';
import { errorText, factorText, kNone, msText, psnrText, spreadText } from './text';
import { words } from './words';

export interface Section {
  readonly id: string;
  readonly title: string;
  readonly element: HTMLElement;
  readonly draw: (clock: Clock) => void;
}

/** A card with a heading and a line about it. */
export function card(id: string, title: string, about: string): HTMLElement {
  const section = make('section', '', 'card');
  section.id = id;
  section.append(make('h2', title));
  if (about !== '') section.append(make('p', about, 'about'));
  return section;
}

/** Puts a plot in its place, as wide as that is. */
export function place(holder: HTMLElement, plot: (width: number) => SVGElement | null): void {
  const drawn = plot(Math.max(280, holder.clientWidth));
  holder.replaceChildren(...(drawn ? [drawn] : [make('p', 'No row has this time.', 'faint')]));
}

const exactness = ({ skipped, exact }: PictureError): 'good' | 'bad' | 'faint' =>
  skipped !== null ? 'faint' : exact ? 'good' : 'bad';

/** What a row's columns of errors are; shared by every table of rows. */
export const kErrorColumns: readonly Column<Row>[] = [
  {
    head: 'R1',
    title: 'Compared with every light on the same device: must be 0',
    text: ({ error_r1: e }) => (e.exact ? '0' : errorText(e.linear?.max_abs)),
    number: true,
    hint: ({ error_r1: e }) => e.skipped,
    state: ({ error_r1: e }) => exactness(e),
  },
  {
    head: 'R2 largest',
    title:
      'Compared with double-precision shading on the host: largest absolute error of linear radiance',
    text: ({ error_r2: e }) => errorText(e.linear?.max_abs),
    number: true,
    hint: ({ error_r2: e }) => e.skipped ?? (e.view === null ? null : `worst view: ${e.view}`),
  },
  { head: 'RMSE', text: ({ error_r2: e }) => errorText(e.linear?.rmse), number: true },
  {
    head: 'FLIP',
    title: 'Mean LDR-FLIP',
    text: ({ error_r2: e }) => errorText(e.perceived?.flip),
    number: true,
  },
  {
    head: 'PSNR, dB',
    title: 'Of the 8-bit picture',
    text: ({ error_r2: e }) => psnrText(e),
    number: true,
  },
];

const kLabel: Column<Row> = {
  head: 'row',
  text: ({ label, note }) => (note === null ? words(label) : `${words(label)} *`),
  hint: ({ note }) => note,
};

export function timeColumns(sweep: Sweep, clock: Clock): Column<Row>[] {
  const columns: Column<Row>[] = [
    { head: 'median, ms', text: (row) => msText(timeMs(row, clock)?.median), number: true },
    { head: 'p5 … p95', text: (row) => spreadText(timeMs(row, clock)), number: true },
  ];
  if (sweep.rows.some((row) => speedUp(row, sweep, clock) !== null)) {
    columns.push({
      head: 'vs naive',
      title: 'Times as fast as the fastest naive row with the same picture',
      text: (row) => factorText(speedUp(row, sweep, clock)),
      number: true,
    });
  }
  return [
    ...columns,
    { head: 'frames', text: ({ frames }) => String(frames), number: true },
    {
      head: 'memory',
      title: 'Of the device',
      text: ({ memory_bytes }) => {
        const sum = Object.values(memory_bytes).reduce((total, part) => total + part, 0);
        return sum > 0 ? bytes(sum) : kNone;
      },
      number: true,
    },
  ];
}

function skippedList(skipped: readonly Skipped[]): HTMLElement {
  const fold = make('details');
  fold.append(
    make('summary', `Not measured: ${skipped.length} row${skipped.length === 1 ? '' : 's'}`),
  );
  fold.append(
    table(
      skipped,
      [
        { head: 'row', text: ({ label }) => label },
        { head: 'series', text: ({ series }) => words(series) },
        { head: 'why', text: ({ reason }) => reason },
      ],
      ({ command }) => command,
    ),
  );
  return fold;
}

function notes(rows: readonly Row[]): HTMLElement[] {
  const texts = new Set(rows.flatMap(({ note }) => note ?? []));
  return [...texts].map((text) => make('p', `* ${text}`, 'footnote'));
}

/** Which rows the bars of passes leave out, and why. */
function untold(sweep: Sweep): HTMLElement[] {
  const names = unknownPasses(sweep);
  if (names.length === 0) return [];
  const text = `Times of passes are unknown if the driver wrote no timestamps: ${names.map(words).join(', ')}.`;
  return [make('p', text, 'footnote')];
}

interface Bars {
  readonly title: string;
  readonly axis: string;
  readonly unit: string;
  readonly parts: (sweep: Sweep) => Part[];
}

const kPassBars: Bars = {
  title: 'Where the time goes',
  axis: 'GPU time of the passes, ms',
  unit: 'ms',
  parts: passParts,
};
const kMemoryBars: Bars = {
  title: 'Where the memory goes',
  axis: 'device memory, MB',
  unit: 'MB',
  parts: memoryParts,
};

/** Stacked bars with a switch between amounts and shares. */
function barBlock(
  sweep: Sweep,
  { title, axis, unit, parts }: Bars,
): { element: HTMLElement; draw: () => void } | null {
  const amounts = parts(sweep);
  if (amounts.length === 0) return null;
  const colours = partColours(amounts.map(({ name }) => name));
  const block = make('div', '', 'bars');
  const head = make('div', '', 'row');
  const shared = make('input');
  shared.type = 'checkbox';
  const label = make('label', 'shares');
  label.prepend(shared);
  head.append(make('h3', title), label);
  const holder = make('div', '', 'plot');
  const draw = (): void => {
    const [shown, name, symbol] = shared.checked
      ? [shares(amounts), 'share of the row, %', '%']
      : [amounts, axis, unit];
    place(holder, (width) => partBars(shown, { width, axis: name, unit: symbol, colours }));
  };
  shared.addEventListener('change', draw);
  block.append(head, legend([...colours].map(([name, colour]) => ({ name, colour }))), holder);
  return { element: block, draw };
}

function sweepLegend(
  sweep: Sweep,
  colours: ReadonlyMap<string, string>,
  published: readonly Published[],
): HTMLElement {
  // A published series may share the colour of one of ours, and needs no entry then.
  const entries = [...colours]
    .filter(([, colour], at, all) => all.findIndex(([, other]) => other === colour) === at)
    .map(([name, colour]) => ({ name: words(name), colour, symbol: kDot.path }));
  const shapes = referenceShapes(referencesOf(sweep, published));
  const others = [...shapes].map(([line, { path }]) => ({
    name: `published: ${line}`,
    colour: 'var(--muted)',
    symbol: path,
    hollow: true,
  }));
  return legend(entries.length + others.length > 1 ? [...entries, ...others] : []);
}

export function sweepSection(results: Results, sweep: Sweep): Section {
  const section = card(`sweep-${sweep.name}`, sweep.title, sweep.about);
  const references = referencesOf(sweep, results.published);
  const colours = seriesColours([
    ...sweep.rows.map(({ series }) => series),
    ...references.map(({ series }) => series),
  ]);
  const holder = make('div', '', 'plot');
  const figures = make('div');
  const isMemory = sweep.name === 'memory';
  const bars = barBlock(sweep, isMemory ? kMemoryBars : kPassBars);
  const stream = sweep.rows.filter((row) => row.stream !== null);
  if (stream.length > 0) {
    section.append(sweepLegend(sweep, colours, []), holder, streamTable(stream));
  } else if (sweep.rows.length > 0) {
    section.append(
      sweepLegend(sweep, colours, results.published),
      holder,
      figures,
      ...notes(sweep.rows),
    );
    if (bars) section.append(bars.element);
    if (!isMemory) section.append(...untold(sweep));
  } else {
    section.append(make('p', 'Nothing was measured.', 'faint'));
  }
  if (sweep.rows.length > 0) section.append(commandLines(sweep.rows));
  if (sweep.skipped.length > 0) section.append(skippedList(sweep.skipped));
  const several = colours.size > 1;
  const series: Column<Row>[] = several
    ? [{ head: 'series', text: (row) => words(row.series) }]
    : [];
  return {
    id: section.id,
    title: sweep.title,
    element: section,
    draw: (clock) => {
      if (stream.length > 0) {
        place(holder, (width) => streamPlot(stream, { width, colours }));
        return;
      }
      if (sweep.rows.length === 0) return;
      place(holder, (width) =>
        sweepPlot(sweep, { clock, width, colours, published: results.published }),
      );
      figures.replaceChildren(
        table(
          sweep.rows,
          [kLabel, ...series, ...timeColumns(sweep, clock), ...kErrorColumns],
          ({ command }) => command,
        ),
      );
      bars?.draw();
    },
  };
}

/** Figures of others, as they printed them. */
export function publishedSection(results: Results): Section {
  const section = card(
    'published',
    'Published figures of others',
    'Measured on other hardware, with other scenes: compare the shapes of the curves, not the times.',
  );
  const fold = make('details');
  fold.append(make('summary', `${results.published.length} series`));
  section.append(fold);
  for (const line of results.published) {
    fold.append(
      make('h3', `${line.source}: ${words(line.series)}`),
      make('p', `${line.hardware}. ${line.note}`, 'about'),
      table(line.rows, [
        { head: words(line.variable), text: ({ value }) => shortNumber(value), number: true },
        { head: 'ms', text: ({ ms }) => msText(ms), number: true },
        { head: 'as printed', text: ({ published }) => published },
      ]),
    );
  }
  return { id: section.id, title: 'Published figures', element: section, draw: () => undefined };
}

/** How it was measured. */
export function methodSection(results: Results): Section {
  const section = card('method', 'Method', '');
  const { device, host, build, scene, method, views } = results;
  const entries: [string, string][] = [
    ['device', `${device.name}, driver ${device.driver}, Vulkan ${device.vulkan}`],
    ['host', `${host.cpu}, ${host.threads} threads`],
    ['build', `froxel ${results.froxel}, ${build.type}, ${build.compiler}`],
    ['scene', `${scene.name} (${scene.source}), ${count(scene.triangles)} triangles`],
    ['camera path', views.map(({ name }) => name).join('; ')],
    ...Object.entries(method).map(([name, value]): [string, string] => [
      words(name),
      Array.isArray(value)
        ? value.join(' × ')
        : typeof value === 'number'
          ? shortNumber(value)
          : String(value),
    ]),
  ];
  const list = make('dl');
  for (const [name, value] of entries) list.append(make('dt', name), make('dd', value));
  section.append(list);
  return { id: section.id, title: 'Method', element: section, draw: () => undefined };
}
