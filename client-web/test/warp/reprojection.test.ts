import { beforeEach, describe, expect, it } from 'vitest';

import { vec } from '../../src/core/vec3';
import type { FrameHeader } from '../../src/gen/froxel/v1/server_pb';
import type { DepthMesh } from '../../src/warp/depth_mesh';
import { Reprojection, type Wanted } from '../../src/warp/reprojection';
import type { Surface } from '../../src/warp/warp_surface';
import { FakeFrames, frameHeader } from '../fakes';
import { sampleSettings } from '../sample';

const kMesh: DepthMesh = {
  number: 4n,
  columns: 3,
  rows: 2,
  cellPx: 8,
  steps: new Uint16Array([1, 1, 1, 1, 1, 1]),
  perStep: 0.2,
  nearestPerM: 0.2,
  medianPerM: 0.2,
};

class FakeSurface implements Surface {
  visible = false;
  draws = 0;
  pictures = 0;
  meshes = 0;
  setPicture = (): void => void (this.pictures += 1);
  setMesh = (): void => void (this.meshes += 1);
  draw = (): void => void (this.draws += 1);
  show = (visible: boolean): void => void (this.visible = visible);
}

let surface: FakeSurface;
let frames: FakeFrames;
let wanted: Wanted | null;
let openBitmaps: number;
let warp: Reprojection;
let nowMs: number;

const view = (x: number, change: Partial<Wanted> = {}): Wanted => ({
  ...sampleSettings({ eye: vec(x, 0, 0), target: vec(x, 0, -5), fovDeg: 90 }),
  orthographic: false,
  up: vec(0, 1, 0),
  width: 17,
  height: 9,
  ...change,
});

type HeaderInit = NonNullable<Parameters<typeof frameHeader>[0]>;

const kCamera = { right: { x: 1 }, up: { y: 1 }, halfHeight: 1 };
const bare = (change: HeaderInit = {}): FrameHeader =>
  frameHeader({ width: 17, height: 9, depthMesh: 4n, ...(change as object) });
const header = (change: HeaderInit = {}): FrameHeader =>
  bare({ pictureCamera: kCamera, ...(change as object) });
const from = (x: number): FrameHeader => header({ pictureCamera: { ...kCamera, eye: { x } } });

function bitmap(): ImageBitmap {
  openBitmaps += 1;
  return { width: 17, height: 9, close: () => void (openBitmaps -= 1) };
}

function moveTo(next: Wanted | null): void {
  wanted = next;
  warp.cameraMoved();
  frames.run();
}

beforeEach(() => {
  surface = new FakeSurface();
  frames = new FakeFrames();
  wanted = view(0);
  openBitmaps = 0;
  nowMs = 10_000;
  warp = new Reprojection({ surface, wanted: () => wanted, nextFrame: frames.next, nowMs: () => nowMs });
  warp.setMesh(kMesh);
});

describe('Reprojection', () => {
  it('CameraOfThePicture_ShowsThePictureItself', () => {
    warp.setPicture(bitmap(), header());
    expect([surface.visible, surface.draws, surface.pictures]).toEqual([false, 0, 0]);
  });

  it('CameraThatMoves_IsShownAtOnce_AndThePictureIsUploadedOnce', () => {
    warp.setPicture(bitmap(), header());
    moveTo(view(0.1));
    expect([surface.visible, surface.draws, surface.pictures, surface.meshes]).toEqual([true, 1, 1, 1]);
    moveTo(view(0.2));
    expect([surface.draws, surface.pictures]).toEqual([2, 1]);
    moveTo(view(0));
    expect(surface.visible).toBe(false);
  });

  it('NewPicture_TakesItsPlaceWithinItsOwnFrame', () => {
    warp.setPicture(bitmap(), header());
    moveTo(view(0.1));
    warp.setPicture(bitmap(), from(-0.1));
    expect([surface.visible, surface.draws, surface.pictures]).toEqual([true, 2, 2]);
    warp.setPicture(bitmap(), from(0.1));
    expect(surface.visible).toBe(false);
    expect(openBitmaps).toBe(1);
  });

  it('MeshesOfPicturesOnTheirWay_WaitForThem', () => {
    for (const number of [5n, 6n]) warp.setMesh({ ...kMesh, number });
    warp.setPicture(bitmap(), header({ depthMesh: 5n }));
    moveTo(view(0.1));
    expect(surface.draws).toBe(1);
    warp.setPicture(bitmap(), header({ depthMesh: 6n }));
    expect(surface.draws).toBe(2);
    warp.setPicture(bitmap(), header({ depthMesh: 5n })); // is not wanted any more
    expect(surface.visible).toBe(false);
  });

  it('NothingNew_IsNotDrawnAgain', () => {
    warp.setPicture(bitmap(), header());
    moveTo(view(0.1));
    warp.cameraMoved();
    frames.run();
    expect(surface.draws).toBe(1);
  });

  it.each([
    ['NoDepth', header({ depthMesh: 0n })],
    ['AnotherMesh', header({ depthMesh: 9n })],
    ['AnotherSize', header({ width: 30 })],
    ['NoCamera', bare()],
    ['BrokenCamera', from(NaN)],
    ['FlatCamera', header({ pictureCamera: { ...kCamera, halfHeight: 0 } })],
  ] as const)('PictureWith%s_ShowsAsItComes', (_, broken) => {
    warp.setPicture(bitmap(), header());
    moveTo(view(0.1));
    warp.setPicture(bitmap(), broken);
    expect(surface.visible).toBe(false);
    expect(openBitmaps).toBe(0);
    moveTo(view(0.2));
    expect(surface.draws).toBe(1);
  });

  it('ScaledPicture_OfTheSameShape_IsWarped', () => {
    warp.setPicture(bitmap(), header());
    moveTo(view(0.1, { width: 34, height: 18 }));
    expect(surface.draws).toBe(1);
    moveTo(view(0.2, { width: 34, height: 30 })); // the window was resized
    expect(surface.visible).toBe(false);
  });

  it('ParallelView_IsNotWarped', () => {
    warp.setPicture(bitmap(), header());
    moveTo(view(0.1));
    moveTo(view(0.1, { orthographic: true }));
    expect(surface.visible).toBe(false);
  });

  it('SomebodyElsesView_MovesFromPictureToPicture', () => {
    wanted = null;
    warp.setPicture(bitmap(), header());
    expect(surface.visible).toBe(false);
    nowMs += 60;
    warp.setPicture(bitmap(), from(1));
    for (let frame = 1; frame <= 3; frame += 1) {
      expect([surface.visible, surface.draws]).toEqual([true, frame]);
      nowMs += 20;
      frames.run();
    }
    expect([surface.visible, surface.draws, frames.count]).toEqual([false, 3, 0]);
    nowMs += 60;
    warp.setPicture(bitmap(), from(50)); // another view, of which that picture has nothing
    expect(surface.visible).toBe(false);
  });

  it('AViewThatThePictureHardlyHas_IsWaitedFor', () => {
    warp.setPicture(bitmap(), header());
    moveTo(view(0.1));
    moveTo(view(50));
    expect([surface.visible, surface.draws]).toEqual([true, 1]);
    warp.setPicture(bitmap(), from(20)); // is nearer, and not near
    expect([surface.visible, surface.draws]).toEqual([false, 1]);
  });

  it('Restart_LetsGoOfPictureAndMesh', () => {
    warp.setPicture(bitmap(), header());
    moveTo(view(0.1));
    warp.restart();
    expect([surface.visible, openBitmaps]).toEqual([false, 0]);
    warp.setPicture(bitmap(), header()); // of the mesh before
    moveTo(view(0.2));
    expect(surface.draws).toBe(1);
  });
});
