// A contact sheet: every glTF file below a folder as froxel shows it, by default or with options of froxel
// render. deploy/compare.sh runs it.

import { writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';

import { freshFolder, given, scenesIn } from './files';
import { htmlPage, type Figure } from './html';
import { clipped, render, sceneFacts } from './programs';

const percent = (share: number | null): string => (share === null ? 'none' : `${(share * 100).toFixed(1)} %`);

async function drawn(scene: string, name: string, folder: string, options: readonly string[]): Promise<Figure> {
  const { warnings } = await sceneFacts(scene);
  const file = `${name.replaceAll('/', '.')}.png`;
  const depthView = join(folder, `${file}.depth.png`);
  const begin = performance.now();
  await render(scene, join(folder, file), options);
  const seconds = (performance.now() - begin) / 1000;
  await render(scene, depthView, [...options, '--debug-view', 'depth']);
  const { surface, black, blown } = await clipped(join(folder, file), depthView);
  return {
    name,
    pictures: [{ file, caption: `${seconds.toFixed(1)} s` }],
    lines: [`solid surfaces ${percent(surface)}; of them black ${percent(black)}, blown out ${percent(blown)}`, ...warnings],
  };
}

/** A file that cannot be drawn is on the sheet, too. */
async function figureOf(...args: Parameters<typeof drawn>): Promise<Figure> {
  try {
    return await drawn(...args);
  } catch (error) {
    process.exitCode = 1;
    return { name: args[1], pictures: [], lines: [`not drawn: ${(error as Error).message}`] };
  }
}

const [from, ...options] = process.argv.slice(2);
if (from === undefined) throw new Error('FOLDER is missing: where the glTF files are');
const scenes = scenesIn(given(from));
const folder = freshFolder('sheet');
const figures: Figure[] = [];
for (const scene of scenes) {
  const figure = await figureOf(scene, relative(given(from), scene), folder, options);
  figures.push(figure);
  console.log([figure.name, ...figure.pictures.map(({ caption }) => caption), ...figure.lines].join('\n  '));
}
writeFileSync(join(folder, 'index.html'), htmlPage(`${from}: ${figures.length} files`, figures));
console.log(`\n${join(folder, 'index.html')}`);
