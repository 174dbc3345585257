// The report of `froxel diff`: a table of all pairs, and the worst of them side by side.

import { element, make } from '../src/core/dom';
import { count } from '../src/core/format';
import { readDiff, type Difference, type DiffResults, type Pair, type Pictures } from './diff_results';
import { card } from './sections';
import { table, type Column } from './table';
import { errorText, kNone } from './text';

/** Of colours the step from 0 to 255, of radiance its own unit. */
function largestText({ max, unit }: Difference): string {
  if (max === null) return kNone;
  return unit === 'srgb' ? `${Math.round(255 * max)}/255` : errorText(max);
}

const shareText = ({ differing, pixels }: Difference): string => `${count(differing)} of ${count(pixels)}`;

function firstText({ first, unit }: Difference): string {
  if (!first) return '';
  const colour = (values: readonly number[]): string =>
    values.map((value) => (unit === 'srgb' ? String(Math.round(255 * value)) : errorText(value))).join(' ');
  return `The first is (${first.x}, ${first.y}): ${colour(first.picture)} instead of ${colour(first.reference)}.`;
}

const state = ({ failed, difference }: Pair): string => (failed ? 'failed' : difference?.equal ? 'equal' : 'within limits');

const kColumns: readonly Column<Pair>[] = [
  { head: 'picture', text: ({ name }) => name },
  { head: '', text: state, state: ({ failed }) => (failed ? 'bad' : 'good'), hint: ({ faults }) => faults.join('; ') },
  { head: 'FLIP', text: ({ difference }) => errorText(difference?.flip), number: true },
  { head: 'RMSE', text: ({ difference }) => errorText(difference?.rmse), number: true },
  { head: 'SSIM', text: ({ difference }) => difference?.mssim?.toFixed(4) ?? kNone, number: true },
  { head: 'largest', text: ({ difference }) => (difference ? largestText(difference) : kNone), number: true },
  { head: 'pixels that differ', text: ({ difference }) => (difference ? shareText(difference) : kNone), number: true },
];

function image(className: string, url: string, alt: string): HTMLImageElement {
  const picture = make('img', '', className);
  picture.src = url;
  picture.alt = alt;
  return picture;
}

/** Both pictures with a divider between them, or the heat map in their place. */
function slider(name: string, pictures: Pictures): HTMLElement[] {
  const frame = make('div', '', 'pair');
  const reference = image('reference', pictures.reference, `${name}: the reference`);
  frame.append(reference, image('picture', pictures.picture, `${name}: the picture`));
  const at = make('input');
  at.type = 'range';
  at.min = '0';
  at.max = '100';
  at.step = '0.1';
  at.value = '50';
  at.setAttribute('aria-label', `Divider: ${name} on its left, the reference on its right`);
  const move = (): void => frame.style.setProperty('--at', `${at.value}%`);
  at.addEventListener('input', move);
  move();
  const choice = make('div', '', 'choice');
  choice.append(make('span', 'picture'), at, make('span', 'reference'));
  if (pictures.flip !== undefined) {
    const { flip } = pictures;
    const box = make('input');
    box.type = 'checkbox';
    const label = make('label', '');
    label.append(box, ' heat map of FLIP');
    box.addEventListener('change', () => {
      frame.classList.toggle('flip', box.checked);
      reference.src = box.checked ? flip : pictures.reference;
      reference.alt = `${name}: ${box.checked ? 'heat map of FLIP' : 'the reference'}`;
      at.disabled = box.checked;
    });
    choice.append(label);
  }
  return [frame, choice];
}

function pairSection(pair: Pair, index: number): HTMLElement | null {
  const { name, pictures, difference, faults } = pair;
  if (!pictures || !difference) return null;
  const section = card(`pair-${index}`, name, '');
  for (const fault of faults) section.append(make('p', fault, 'warning'));
  section.append(
    make(
      'p',
      `FLIP ${errorText(difference.flip)}, RMSE ${errorText(difference.rmse)}; ${shareText(difference)} pixels differ. ${firstText(difference)}`,
      'about',
    ),
    ...slider(name, pictures),
  );
  return section;
}

function show(results: DiffResults): void {
  const head = element('head', HTMLElement);
  head.append(
    make('h1', 'Froxel: difference between pictures'),
    make('p', `${results.picture} · reference ${results.reference}`, 'where'),
  );
  const { pairs } = results;
  const equal = pairs.filter(({ difference }) => difference?.equal).length;
  const tiles = make('ul', '', 'tiles');
  for (const { value, name, bad } of [
    { value: pairs.length, name: 'pairs of pictures', bad: false },
    { value: equal, name: 'equal', bad: false },
    { value: results.failed, name: 'failed', bad: results.failed > 0 },
  ]) {
    const tile = make('li', '', bad ? 'bad' : '');
    tile.append(make('b', count(value)), make('span', name));
    tiles.append(tile);
  }
  head.append(tiles);
  const report = element('report', HTMLElement);
  const all = card('pairs', 'Pairs', 'FLIP and SSIM are means over all pixels; RMSE is of colours from 0 to 1, or of radiance.');
  all.append(table(pairs, kColumns));
  report.append(all);
  const shown = pairs.flatMap((pair, index) => pairSection(pair, index) ?? []);
  report.append(...shown);
  const unlike = pairs.filter(({ difference }) => difference !== null && !difference.equal).length;
  if (unlike > shown.length) {
    report.append(make('p', `The ${shown.length} worst of ${unlike} pairs are shown; the table has all.`, 'footnote'));
  }
}

try {
  show(readDiff(element('results', HTMLScriptElement).textContent));
} catch (error) {
  element('report', HTMLElement).append(make('p', error instanceof Error ? error.message : String(error), 'warning'));
}
