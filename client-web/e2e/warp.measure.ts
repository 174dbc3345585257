// How far the picture from the camera of now is from the server's own of that camera, by mean LDR-FLIP: the server is
// held, the camera moved, and what the page shows is compared with what the server draws when it goes on. Prints a table.
//   FROXEL_SCENE   the .gltf file of Sponza, which the views are of

import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { it } from 'vitest';

import { difference } from '../compare/programs';
import { add, cross, length, normalize, scale, sub, vec, type Vec } from '../src/core/vec3';
import { fly, look, orbit, type Pose } from '../src/steering/camera_controller';
import { launch } from './chromium';
import { startServer, type Server } from './server';
import { until, Viewer } from './viewer';

const kWidth = 640;
const kHeight = 360;
/** As every pixel is, so that pictures differ by the warp alone. */
const kSettings = `#size=${kWidth}x${kHeight}&animate=0&refine=none&quality=95&chroma=444&lights=500`;

/** In Sponza: along the nave, and close to pillars and plants at its side. */
const kUp = vec(0, 1, 0);
const kViews: ReadonlyMap<string, Pose> = new Map([
  ['nave', { eye: vec(-7, 2, 0), target: vec(0, 2, 0), up: kUp }],
  ['side', { eye: vec(-2, 1.6, 2.6), target: vec(3, 1.6, -1.5), up: kUp }],
]);

const shift = ({ eye, target, up }: Pose, by: Vec): Pose => ({ eye: add(eye, by), target: add(target, by), up });
const radians = (degrees: number): number => (degrees * Math.PI) / 180;

function right({ eye, target }: Pose): Vec {
  return normalize(cross(sub(target, eye), kUp), vec(1, 0, 0));
}

const kMoves: ReadonlyMap<string, (pose: Pose) => Pose> = new Map([
  ['turn 3 degrees', (pose: Pose): Pose => look(pose, radians(3), 0)],
  ['strafe 0.1 m', (pose: Pose): Pose => shift(pose, scale(right(pose), 0.1))],
  ['strafe 0.4 m', (pose: Pose): Pose => shift(pose, scale(right(pose), 0.4))],
  ['forward 0.4 m', (pose: Pose): Pose => fly(pose, 0, 0, 0.4)],
  ['orbit 1 degree', (pose: Pose): Pose => orbit(pose, radians(1), 0)],
  ['orbit 2 degrees', (pose: Pose): Pose => orbit(pose, radians(2), 0)],
  ['orbit 6 degrees', (pose: Pose): Pose => orbit(pose, radians(6), 0)],
]);

const text = ({ x, y, z }: Vec): string => [x, y, z].join(',');

/** As a link to that view that somebody opens in the page. */
async function goTo({ page }: Viewer, { eye, target }: Pose): Promise<void> {
  const hash = `${kSettings}&eye=${text(eye)}&target=${text(target)}&up=0,1,0`;
  await page.evaluate((to) => {
    location.hash = to;
  }, hash);
}

interface Measured {
  readonly folder: string;
  readonly server: Server;
  readonly viewer: Viewer;
}

async function measure({ folder, server, viewer }: Measured, name: string, from: Pose, to: Pose): Promise<string> {
  const shot = async (what: string): Promise<string> => {
    const file = join(folder, `${name}-${what}.png`.replaceAll(/[ ,]+/g, '_'));
    writeFileSync(file, await viewer.page.screenshot());
    return file;
  };
  const isShown = ({ eye }: Pose): boolean => {
    const at = viewer.lastFrame?.pictureCamera?.eye;
    return at !== undefined && length(sub(eye, vec(at.x, at.y, at.z))) < 1e-6;
  };
  const arrive = async (pose: Pose): Promise<void> => {
    await until('a picture from there', () => isShown(pose));
    await viewer.settled();
    await until('the picture itself', async () => !(await viewer.page.locator('#warp').isVisible()));
  };
  await goTo(viewer, from);
  await arrive(from);
  const before = await shot('before');
  server.hold(true);
  await goTo(viewer, to);
  await until('another camera', () => viewer.page.locator('#warp').isVisible());
  const warped = await shot('warped');
  server.hold(false);
  await arrive(to);
  const after = await shot('after');
  const [without, shown] = [await difference(before, after), await difference(warped, after)];
  return `${name}\t${without.flip.toFixed(3)}\t${shown.flip.toFixed(3)}`;
}

it('Warp_AgainstTheServersPicture', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'froxel-warp-'));
  const scene = process.env.FROXEL_SCENE;
  const server = await startServer(0, scene ? ['--scene', scene] : []);
  const browser = await launch();
  try {
    const viewer = await Viewer.open(browser, server.url + kSettings, { viewport: { width: kWidth, height: kHeight } });
    await until('depth', () => viewer.depthCount > 0);
    await viewer.page.addStyleTag({ content: 'body > :not(:has(canvas)), :has(> canvas) > :not(canvas) { display: none !important }' });
    console.log('move\twithout a warp\twarped');
    for (const [view, from] of kViews) {
      for (const [move, moved] of kMoves) {
        console.log(await measure({ folder, server, viewer }, `${view}, ${move}`, from, moved(from)));
      }
    }
    console.log(`pictures in ${folder}`);
  } finally {
    server.hold(false);
    await browser.close();
    await server.stop();
  }
});
