// Draws files by froxel and by three.js, and says how far the pictures are apart. deploy/compare.sh runs it.

import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import { ThreeJs } from './browser';
import { freshFolder, given, nameOf, scenesIn, sharedScenes } from './files';
import { htmlPage, type Figure } from './html';
import { noteOf } from './notes';
import { difference, kRoot, render, sceneFacts, writeFeatures } from './programs';
import { kMostFlip, table, unexplained, withTable, type Row } from './table';
import { cameraText, farthest, kNear, lightAround, overview, type Light, type Size, type View } from './view';

const kPage = join(kRoot, 'docs/figures/three.md');
const kBackground = [0.0006, 0.0037, 0.0103]; // what the tone map makes of drawing.ts's
const kSize: Size = { width: 640, height: 480 };

async function byFroxel(scene: string, out: string, view: View, { lamps, exposure }: Light): Promise<void> {
  const set = `${out}.lights.json`;
  writeFileSync(set, JSON.stringify({ lights: lamps }));
  await render(scene, out, [
    ...['--camera', cameraText(view), '--size', `${kSize.width}x${kSize.height}`, '--exposure', String(exposure)],
    ...['--lights', '0', '--ambient', '0', '--environment', 'off', '--exposure-mode', 'fixed'],
    ...['--background-color', kBackground.join(','), '--background-gradient', '0'],
    ...(lamps.length > 0 ? ['--light-set', set, '--no-scene-lights'] : []),
  ]);
}

interface Compared {
  readonly row?: Row; // none: not drawn by one of them
  readonly figure: Figure;
}

async function compare(scene: string, folder: string, three: ThreeJs): Promise<Compared> {
  const name = nameOf(scene);
  const { ownLights = false, why } = noteOf(name);
  const { sphere, warnings } = await sceneFacts(scene);
  const view = overview(sphere);
  const light = ownLights ? { lamps: [], exposure: 1 } : lightAround(sphere);
  const pictures = [
    { file: `${name}.froxel.png`, caption: 'Froxel' },
    { file: `${name}.three.png`, caption: 'three.js' },
  ] as const;
  const [froxels, theirs] = [join(folder, pictures[0].file), join(folder, pictures[1].file)];
  await byFroxel(scene, froxels, view, light);
  const far = farthest(view, sphere);
  writeFileSync(theirs, await three.draw(scene, { size: kSize, view, near: kNear, far, ownLights, light }));
  const { flip, mssim, drawn } = await difference(froxels, theirs);
  const numbers = `FLIP ${flip.toFixed(4)}, SSIM ${mssim.toFixed(4)}`;
  const lines = [numbers, ...(why === undefined ? [] : [why]), ...warnings];
  return { row: { name, flip, drawn, mssim, why }, figure: { name, pictures, lines } };
}

async function tried(scene: string, folder: string, three: ThreeJs): Promise<Compared> {
  try {
    return await compare(scene, folder, three);
  } catch (error) {
    process.exitCode = 1;
    return { figure: { name: nameOf(scene), pictures: [], lines: [`not compared: ${(error as Error).message}`] } };
  }
}

async function compareAll(scenes: readonly string[], folder: string): Promise<Compared[]> {
  const three = await ThreeJs.open();
  try {
    const all: Compared[] = [];
    for (const scene of scenes) {
      const compared = await tried(scene, folder, three);
      all.push(compared);
      console.log(`${compared.figure.name}: ${compared.figure.lines[0] ?? ''}`);
    }
    return all;
  } finally {
    await three.close();
  }
}

async function usualScenes(folder: string): Promise<string[]> {
  const made = join(folder, 'made');
  mkdirSync(made);
  await writeFeatures(made);
  return [...scenesIn(made), ...sharedScenes()];
}

const { values, positionals } = parseArgs({ options: { write: { type: 'boolean' } }, allowPositionals: true });
const folder = freshFolder('three');
const scenes = positionals.length > 0 ? positionals.map(given) : await usualScenes(folder);
const all = await compareAll(scenes, folder);
const rows = all.flatMap(({ row }) => (row ? [row] : []));
writeFileSync(join(folder, 'index.html'), htmlPage('Froxel and three.js', all.map(({ figure }) => figure)));
console.log(`\n${table(rows)}\n\npictures: ${join(folder, 'index.html')}`);
if (values.write) writeFileSync(kPage, withTable(readFileSync(kPage, 'utf8'), table(rows)));
for (const name of unexplained(rows)) {
  console.error(`${name}: FLIP is above ${kMostFlip}, and client-web/compare/notes.ts does not say why`);
  process.exitCode = 1;
}
