// The report's head: what ran where, and what came out in four figures.

import { make } from '../src/core/dom';
import { count } from '../src/core/format';
import type { Clock, Results, Row } from './results';
import { kClocks } from './results';
import { durationText, errorText, kClockNames, kClockWords, kNone } from './text';

export interface Figure {
  readonly name: string;
  readonly value: string;
  readonly about: string;
  readonly bad?: boolean;
}

const largest = (values: readonly (number | null | undefined)[]): number | null => {
  const known = values.filter((value): value is number => typeof value === 'number');
  return known.length > 0 ? Math.max(...known) : null;
};

/** Rows with default settings but for the number of lights; every row where there are none. */
function usualRows(results: Results, rows: readonly Row[]): readonly Row[] {
  const counts = results.sweeps.find(({ name }) => name === 'light_count')?.rows ?? [];
  const usual = counts.filter(({ settings }) => settings.renderer === 'clustered_deferred');
  return usual.length > 0 ? usual : rows;
}

/** Exactness and the worst error of a run. */
export function figuresOf(results: Results): Figure[] {
  const rows: Row[] = results.sweeps.flatMap((sweep) => sweep.rows);
  const usual = usualRows(results, rows);
  const checked = rows.filter(({ error_r1 }) => error_r1.skipped === null);
  const exact = checked.filter(({ error_r1 }) => error_r1.exact);
  const skipped = results.sweeps.reduce((sum, sweep) => sum + sweep.skipped.length, 0);
  const flip = largest(usual.map(({ error_r2 }) => error_r2.perceived?.flip));
  return [
    {
      name: 'exact against every light (R1)',
      value: `${exact.length} of ${checked.length}`,
      about:
        checked.length < rows.length
          ? `not compared: ${rows.length - checked.length}`
          : 'every row compared',
      bad: exact.length < checked.length,
    },
    {
      name: 'largest mean FLIP (R2)',
      value: errorText(flip),
      about: usual.length < rows.length ? 'default settings, any number of lights' : 'of every row',
    },
    {
      name: 'rows measured',
      value: count(rows.length),
      about: skipped > 0 ? `${skipped} skipped, with reasons` : 'none left out',
    },
    {
      name: 'wall time',
      value: durationText(results.elapsed_s),
      about: results.date.replace('T', ' ').replace('Z', ' UTC'),
    },
  ];
}

function clockPicker(results: Results, clock: Clock, choose: (clock: Clock) => void): HTMLElement {
  const label = make('label', 'Times shown', 'picker');
  const pick = make('select');
  for (const name of kClocks) {
    if (!results.sweeps.some(({ rows }) => rows.some((row) => row[name] !== null))) continue;
    const option = make('option', kClockNames[name]);
    option.value = name;
    option.selected = name === clock;
    pick.append(option);
  }
  const about = make('span', kClockWords[clock], 'about');
  pick.addEventListener('change', () => {
    const chosen = kClocks.find((name) => name === pick.value) ?? clock;
    about.textContent = kClockWords[chosen];
    choose(chosen);
  });
  label.append(pick, about);
  return label;
}

/** Fills the head. */
export function showHead(
  head: HTMLElement,
  results: Results,
  clock: Clock,
  choose: (clock: Clock) => void,
): void {
  const { device, scene, host } = results;
  const where = [
    device.name || kNone,
    `${scene.name}, ${count(scene.triangles)} triangles`,
    host.cpu,
  ].join(' · ');
  head.append(make('h1', 'Froxel: speed against error'), make('p', where, 'where'));
  if (!results.complete) {
    head.append(make('p', 'The run was stopped early. These are the rows measured before.', 'warning'));
  }
  const tiles = make('ul', '', 'tiles');
  for (const { name, value, about, bad } of figuresOf(results)) {
    const tile = make('li', '', bad ? 'bad' : '');
    tile.append(make('b', value), make('span', name), make('small', about));
    tiles.append(tile);
  }
  head.append(tiles, clockPicker(results, clock, choose));
}
