// How far the picture from the camera of now is from the server's own of that camera, by mean LDR-FLIP: the server is
// held, the camera moved, and what the page shows is compared with a still of that camera. Prints tables: of single
// moves, and of drags over links with a delay.
//   FROXEL_SCENE   the .gltf file of Sponza, which the views are of

import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { it } from 'vitest';

import { difference } from '../compare/programs';
import { add, cross, normalize, scale, sub, vec, type Vec } from '../src/core/vec3';
import { fly, look, orbit, type Pose } from '../src/steering/camera_controller';
import { AskedCamera } from '../src/warp/asked_camera';
import type { CameraSettings as Camera } from '../src/settings/settings';
import { launch } from './chromium';
import { kPicture, kPictureAlone, kSizePx, kUp, kViews, Sponza } from './sponza';
import { seenVertices } from './seen';
import { startServer } from './server';
import { until, Viewer } from './viewer';

const radians = (degrees: number): number => (degrees * Math.PI) / 180;
const turned = (pose: Pose, degrees: number): Pose => orbit(pose, radians(degrees), 0);
const shift = ({ eye, target, up }: Pose, by: Vec): Pose => ({ eye: add(eye, by), target: add(target, by), up });

function right({ eye, target }: Pose): Vec {
  return normalize(cross(sub(target, eye), kUp), vec(1, 0, 0));
}

const kMoves: ReadonlyMap<string, (pose: Pose) => Pose> = new Map([
  ['turn 3 degrees', (pose: Pose): Pose => look(pose, radians(3), 0)],
  ['strafe 0.1 m', (pose: Pose): Pose => shift(pose, scale(right(pose), 0.1))],
  ['strafe 0.4 m', (pose: Pose): Pose => shift(pose, scale(right(pose), 0.4))],
  ['forward 0.4 m', (pose: Pose): Pose => fly(pose, 0, 0, 0.4)],
  ['orbit 1 degree', (pose: Pose): Pose => turned(pose, 1)],
  ['orbit 2 degrees', (pose: Pose): Pose => turned(pose, 2)],
  ['orbit 6 degrees', (pose: Pose): Pose => turned(pose, 6)],
]);

/** Degrees of an orbit, after a time in seconds. */
type Drag = (s: number) => number;

/** At an even 30 degrees a second, to and fro. */
const sweep: Drag = (s) => 10 - Math.abs(((30 * s) % 40) - 20);

/** As hands do (Flash, Hogan 1985): 20 degrees in 0.8 s, of least jerk, and a rest. */
const strokes: Drag = (s) => {
  const [stroke, rest] = [0.8, 0.3];
  const turn = Math.floor(s / (stroke + rest));
  const t = Math.min(1, (s - turn * (stroke + rest)) / stroke);
  const share = t ** 3 * (10 - 15 * t + 6 * t * t);
  return turn % 2 === 0 ? -10 + 20 * share : 10 - 20 * share;
};

const kDrags: ReadonlyMap<string, Drag> = new Map([
  ['sweep', sweep],
  ['strokes', strokes],
]);
/** From telling a pose to its picture on the screen, so that pictures are 66 and 200 ms old on average. */
const kDelaysMs: readonly number[] = [33, 167];
const kPictureMs = 1000 / 15; // from a picture to the next
const kFrameMs = 1000 / 60;
const kDragMs = 5_000;
const kSampleMs = 317; // no multiple of the others

interface Instant {
  readonly picture: Camera; // that the newest picture is from
  readonly now: Camera;
}

/** What a page has over a link, at some times of a drag. `asks`: for cameras that are ahead, as the page does. */
function instantsOf(from: Camera, drag: Drag, delayMs: number, asks: boolean): Instant[] {
  const asked = new AskedCamera();
  const told: Camera[] = []; // of each frame
  const at = (ms: number): Camera => ({ ...from, ...turned(from, drag(ms / 1000)) });
  for (let ms = 0; ms < kDragMs; ms += kFrameMs) told.push(asks ? asked.of(at(ms), ms, delayMs) : at(ms));
  const instants: Instant[] = [];
  for (let ms = 2 * kSampleMs; ms < kDragMs; ms += kSampleMs) {
    const begunMs = Math.floor((ms - delayMs) / kPictureMs) * kPictureMs;
    const picture = told[Math.floor(begunMs / kFrameMs)];
    if (picture) instants.push({ picture, now: at(ms) });
  }
  return instants;
}

interface Errors {
  readonly without: number; // without a warp
  readonly shown: number;
  readonly seen: number | null; // of what the picture has; null: nothing
  readonly unseen: number; // share of the pixels
}

async function errorsOf(sponza: Sponza, folder: string, { picture, now }: Instant): Promise<Errors> {
  const file = (what: string, png: Buffer): string => {
    const path = join(folder, `${what}.png`);
    writeFileSync(path, png);
    return path;
  };
  const before = await sponza.arriveAt(picture);
  const still = await sponza.shot();
  const warped = await sponza.warpedTo(now);
  const truth = await sponza.truth(now);
  const after = await sponza.arriveAt(now);
  const seen = seenVertices(after, before);
  const seenShare = seen.filter(Boolean).length / seen.length;
  const reference = file('truth', truth);
  const seenError = async (): Promise<number> => {
    const [masked, maskedTruth] = [await sponza.masked(warped, seen, after), await sponza.masked(truth, seen, after)];
    return (await difference(file('seen', masked), file('seen-truth', maskedTruth))).flip / seenShare;
  };
  return {
    without: (await difference(file('without', still), reference)).flip,
    shown: (await difference(file('shown', warped), reference)).flip,
    seen: seenShare > 0 ? await seenError() : null,
    unseen: 1 - seenShare,
  };
}

const kHead = '\twithout a warp\twarped\twhat the picture has\tnot in the picture';

function row(name: string, errors: readonly Errors[]): string {
  const mean = (key: keyof Errors): number => {
    const values = errors.map((error) => error[key]).filter((value) => value !== null);
    return values.reduce((sum, value) => sum + value, 0) / values.length;
  };
  const flips = [mean('without'), mean('shown'), mean('seen')].map((flip) => flip.toFixed(3));
  return [name, ...flips, `${(100 * mean('unseen')).toFixed(1)} %`].join('\t');
}

async function onSponza(measure: (sponza: Sponza, folder: string) => Promise<void>): Promise<void> {
  const scene = process.env.FROXEL_SCENE;
  const server = await startServer(0, scene ? ['--scene', scene] : []);
  const browser = await launch();
  try {
    const viewer = await Viewer.open(browser, 'about:blank', { viewport: kSizePx });
    const sponza = new Sponza(viewer, server);
    await viewer.page.goto(server.url + kPicture);
    await until('depth', () => viewer.depths.size > 0);
    await viewer.page.addStyleTag({ content: kPictureAlone });
    await measure(sponza, mkdtempSync(join(tmpdir(), 'froxel-warp-')));
  } finally {
    server.hold(false);
    await browser.close();
    await server.stop();
  }
}

it('Moves_AgainstTheServersPictures', async () => {
  await onSponza(async (sponza, folder) => {
    console.log(`move${kHead}`);
    for (const [view, picture] of kViews) {
      for (const [move, moved] of kMoves) {
        console.log(row(`${view}, ${move}`, [await errorsOf(sponza, folder, { picture, now: { ...picture, ...moved(picture) } })]));
      }
    }
  });
});

it('Drags_AgainstTheServersPictures', async () => {
  await onSponza(async (sponza, folder) => {
    console.log(`drag${kHead}`);
    for (const [view, from] of kViews) {
      for (const [drag, path] of kDrags) {
        for (const delayMs of kDelaysMs) {
          for (const asks of [false, true]) {
            const errors: Errors[] = [];
            for (const instant of instantsOf(from, path, delayMs, asks)) errors.push(await errorsOf(sponza, folder, instant));
            console.log(row(`${view}, ${drag}, ${delayMs} ms, ${asks ? 'asked ahead' : 'as it was'}`, errors));
          }
        }
      }
    }
  });
});
