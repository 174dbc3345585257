// The report of `froxel load`: reads the results that stand in the page and shows them.

import { element, make } from '../src/core/dom';
import { bits, count } from '../src/core/format';
import { readLoad, type LoadResults, type LoadViewer, type Served } from './load_results';
import { card, place } from './sections';
import { shortNumber } from './scales';
import { legend, table, type Column } from './table';
import { durationText, kNone, msText } from './text';
import { timePlot, type TimeLine } from './time_plot';

const kListedViewers = 200;

const kPlots: readonly { label: string; lines: readonly TimeLine[] }[] = [
  {
    label: 'viewers',
    lines: [
      { name: 'watching', colour: 'var(--c2)', of: ({ viewers }) => viewers, steps: true },
      { name: 'joining', colour: 'var(--c1)', of: ({ joining }) => joining, steps: true },
      { name: 'refused or failed', colour: 'var(--c0)', of: ({ refused, failed }) => refused + failed, steps: true },
    ],
  },
  {
    label: 'latency, ms',
    lines: [
      { name: '99th percentile', colour: 'var(--c0)', of: ({ latency_p99_ms }) => latency_p99_ms },
      { name: '95th percentile', colour: 'var(--c1)', of: ({ latency_p95_ms }) => latency_p95_ms },
      { name: 'median', colour: 'var(--c2)', of: ({ latency_p50_ms }) => latency_p50_ms },
    ],
  },
  {
    label: 'frames a second, of each viewer on average',
    lines: [
      {
        name: 'frames a second',
        colour: 'var(--c3)',
        of: ({ frames_per_s, viewers }) => (viewers > 0 ? frames_per_s / viewers : null),
      },
    ],
  },
  {
    label: 'longest wait for a frame, ms',
    lines: [{ name: 'longest wait', colour: 'var(--c4)', of: ({ longest_wait_ms }) => longest_wait_ms }],
  },
  {
    label: 'Mbit/s, all viewers together',
    lines: [{ name: 'Mbit/s', colour: 'var(--c5)', of: ({ mbit_per_s }) => mbit_per_s }],
  },
];

const servedText = ({ device, scene, triangles, size, lights, codec }: Served): string =>
  [
    device,
    `${scene}, ${count(triangles)} triangles`,
    `${size.width_px} × ${size.height_px}`,
    `${count(lights)} lights`,
    codec,
  ].join(' · ');

function showHead(head: HTMLElement, results: LoadResults): void {
  head.append(make('h1', 'Froxel: load test'), make('p', results.url, 'where'));
  for (const served of results.served) head.append(make('p', servedText(served), 'where'));
  if (results.stopped) head.append(make('p', 'A signal ended the run early.', 'warning'));
  if (results.ended_early) head.append(make('p', 'The run ended early: a requirement stayed broken.', 'warning'));
  if (results.broken !== null) head.append(make('p', results.broken, 'warning'));
  const failed = results.each.filter(({ failure }) => failure !== null).length;
  const { latency_ms, frames_per_s } = results.all;
  const tiles = make('ul', '', 'tiles');
  const figures = [
    { value: count(results.viewers), name: 'viewers', about: failed > 0 ? `${failed} refused or failed` : 'none failed', bad: failed > 0 },
    { value: `${msText(latency_ms?.p95)} ms`, name: 'latency, 95th percentile', about: `median ${msText(latency_ms?.median)} ms`, bad: false },
    { value: shortNumber(frames_per_s), name: 'frames a second', about: 'all viewers together', bad: false },
    { value: durationText(results.measured_s), name: 'measured', about: results.scripts.map(({ name, share }) => `${name}:${share}`).join(', '), bad: false },
  ];
  for (const { value, name, about, bad } of figures) {
    const tile = make('li', '', bad ? 'bad' : '');
    tile.append(make('b', value), make('span', name), make('small', about));
    tiles.append(tile);
  }
  head.append(tiles);
}

function requirementSection({ requirements }: LoadResults): HTMLElement {
  const section = card('requirements', 'Requirements', '');
  section.append(
    table(requirements, [
      { head: 'requirement', text: ({ requirement }) => requirement },
      { head: 'measured', text: ({ measured }) => (measured === null ? 'no sample' : shortNumber(measured)), number: true },
      { head: '', text: ({ held }) => (held ? 'held' : 'broken'), state: ({ held }) => (held ? 'good' : 'bad') },
    ]),
  );
  return section;
}

interface Numbered {
  readonly number: number;
  readonly viewer: LoadViewer;
}

const kViewerColumns: readonly Column<Numbered>[] = [
  { head: 'viewer', text: ({ number }) => String(number), number: true },
  { head: 'frames/s', text: ({ viewer }) => viewer.frames_per_s.toFixed(1), number: true },
  { head: 'latency p50', text: ({ viewer }) => msText(viewer.latency_ms?.median), number: true },
  { head: 'p95', text: ({ viewer }) => msText(viewer.latency_ms?.p95), number: true },
  { head: 'p99', text: ({ viewer }) => msText(viewer.latency_ms?.p99), number: true },
  { head: 'stall', text: ({ viewer }) => msText(viewer.stall_ms), number: true },
  { head: 'first frame', text: ({ viewer }) => msText(viewer.first_frame_ms), number: true },
  { head: 'a second', text: ({ viewer }) => bits(viewer.received_bytes_per_s * 8), number: true },
  {
    head: 'dropped',
    text: ({ viewer }) => count(viewer.server_dropped + viewer.client_dropped),
    number: true,
  },
  { head: 'errors', text: ({ viewer }) => count(viewer.errors), number: true },
  { head: 'failure', text: ({ viewer }) => viewer.failure ?? kNone, state: ({ viewer }) => (viewer.failure === null ? null : 'bad') },
];

function viewerSection({ each }: LoadResults): HTMLElement {
  const rows = each.slice(0, kListedViewers).map((viewer, index) => ({ number: index + 1, viewer }));
  const about = each.length > rows.length ? `The first ${rows.length} of ${each.length}; the JSON has all. Times in ms.` : 'Times in ms.';
  const section = card('viewers', 'Viewers', about);
  section.append(table(rows, kViewerColumns));
  return section;
}

function show(results: LoadResults): void {
  showHead(element('head', HTMLElement), results);
  const report = element('report', HTMLElement);
  if (results.requirements.length > 0) report.append(requirementSection(results));
  const time = card('time', 'Over time', 'Each point is one second of the run.');
  const holders = kPlots.map(({ label, lines }) => {
    const holder = make('div', '', 'plot');
    if (lines.length > 1) time.append(legend(lines));
    time.append(holder);
    return { label, lines, holder };
  });
  report.append(time, viewerSection(results));
  let width = 0;
  new ResizeObserver(() => {
    if (report.clientWidth === width) return;
    width = report.clientWidth;
    for (const { label, lines, holder } of holders) {
      place(holder, (room) => timePlot(results.series, label, lines, room));
    }
  }).observe(report);
}

try {
  show(readLoad(element('results', HTMLScriptElement).textContent));
} catch (error) {
  element('report', HTMLElement).append(
    make('p', error instanceof Error ? error.message : String(error), 'warning'),
  );
}
