// Draws files by froxel and by three.js, and says how far the pictures are apart. deploy/compare.sh runs it.

import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import { ThreeJs } from './browser';
import { freshFolder, given, nameOf, scenesIn, sharedPanorama, sharedScenes } from './files';
import { htmlPage, type Figure } from './html';
import { noteOf } from './notes';
import { difference, kRoot, render, sceneFacts, writeFeatures, type Difference } from './programs';
import { kMostFlip, table, unexplained, withTable, type Row } from './table';
import { cameraText, farthest, kNear, lightAround, overview, type Light, type Size, type View } from './view';

const kPage = join(kRoot, 'docs/figures/three.md');
const kBackground = [0.0006, 0.0037, 0.0103]; // what the tone map makes of drawing.ts's
const kSize: Size = { width: 640, height: 480 };
const kPanorama = sharedPanorama();

/** What lights a file: its own lights, lamps of ours, or what is around. */
interface Lit extends Light {
  readonly ownLights: boolean;
  readonly environment: string | null;
}

async function byFroxel(scene: string, out: string, view: View, lit: Lit): Promise<void> {
  const { lamps, exposure, ownLights, environment } = lit;
  const set = `${out}.lights.json`;
  writeFileSync(set, JSON.stringify({ lights: lamps }));
  await render(scene, out, [
    ...['--camera', cameraText(view), '--size', `${kSize.width}x${kSize.height}`, '--exposure', String(exposure)],
    ...['--lights', '0', '--ambient', '0', '--exposure-mode', 'fixed', '--scene-light-intensity', '1'],
    ...['--background-color', kBackground.join(','), '--background-gradient', '0'],
    ...(environment === null
      ? ['--environment', 'off']
      : ['--environment', 'file', '--environment-file', environment, '--environment-strength', '1']),
    ...(lamps.length > 0 ? ['--light-set', set] : []),
    ...(ownLights ? [] : ['--no-scene-lights']),
  ]);
}

/** Both pictures, in files whose names begin so, and how far they are apart. */
async function drawBoth(
  { scene, folder, three, prefix }: { scene: string; folder: string; three: ThreeJs; prefix: string },
  { view, far, lit }: { view: View; far: number; lit: Lit },
): Promise<{ pictures: Figure['pictures']; difference: Difference }> {
  const pictures = [
    { file: `${prefix}.froxel.png`, caption: 'Froxel' },
    { file: `${prefix}.three.png`, caption: 'three.js' },
  ] as const;
  const [froxels, theirs] = [join(folder, pictures[0].file), join(folder, pictures[1].file)];
  await byFroxel(scene, froxels, view, lit);
  const { ownLights, environment } = lit;
  const task = { size: kSize, view, near: kNear, far, ownLights, light: lit, environment };
  writeFileSync(theirs, await three.draw(scene, task));
  return { pictures, difference: await difference(froxels, theirs) };
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
  const at = { view, far: farthest(view, sphere) };
  const light = ownLights ? { lamps: [], exposure: 1 } : lightAround(sphere);
  const where = { scene, folder, three };
  const lamps = await drawBoth({ ...where, prefix: name }, { ...at, lit: { ...light, ownLights, environment: null } });
  const lit: Lit = { lamps: [], exposure: 1, ownLights: false, environment: kPanorama };
  const around = kPanorama ? await drawBoth({ ...where, prefix: `${name}.around` }, { ...at, lit }) : null;
  const { flip, mssim, drawn } = lamps.difference;
  const lines = [
    `FLIP ${flip.toFixed(4)}, SSIM ${mssim.toFixed(4)}`,
    ...(around ? [`around: FLIP ${around.difference.flip.toFixed(4)}`] : []),
    ...(why === undefined ? [] : [why]),
    ...warnings,
  ];
  const pictures = [...lamps.pictures, ...(around?.pictures ?? [])];
  const row = { name, flip, drawn, mssim, around: around?.difference.flip ?? null, why };
  return { row, figure: { name, pictures, lines } };
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
      console.log(`${compared.figure.name}: ${compared.figure.lines.slice(0, 2).join(', ')}`);
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
