import { describe, expect, it } from 'vitest';

import { length, sub, vec } from '../../src/core/vec3';
import type { CameraSettings } from '../../src/settings/settings';
import { orbit } from '../../src/steering/camera_controller';
import { AskedCamera } from '../../src/warp/asked_camera';

const kFrameMs = 16;
const kBegin: CameraSettings = {
  eye: vec(0, 0, 8),
  target: vec(0, 0, 0),
  up: vec(0, 1, 0),
  fovDeg: 45,
  orthographic: false,
  halfHeight: 1,
  lensShiftX: 0,
  lensShiftY: 0,
};
const turned = (degrees: number): CameraSettings => ({ ...kBegin, ...orbit(kBegin, (degrees * Math.PI) / 180, 0) });

/** What is asked for at the last of those cameras, a frame apart. */
function asked(cameras: readonly CameraSettings[], leadMs: number): CameraSettings {
  const askedCamera = new AskedCamera();
  const all = cameras.map((camera, i) => askedCamera.of(camera, i * kFrameMs, leadMs));
  return all.at(-1) ?? kBegin;
}

const orbits = (degrees: readonly number[]): CameraSettings[] => degrees.map(turned);
const kEven = Array.from({ length: 12 }, (_, i) => 0.5 * i); // 31 degrees a second
const missed = (camera: CameraSettings, degrees: number): number => length(sub(camera.eye, turned(degrees).eye));

describe('AskedCamera', () => {
  it('EvenOrbit_IsAheadByItsSpeed', () => {
    const move = missed(turned(5.5), 5.5 + 3);
    expect(missed(asked(orbits(kEven), 96), 5.5 + 3)).toBeLessThan(0.1 * move);
  });

  it('LongDelay_IsPredictedInPart', () => {
    expect(asked(orbits(kEven), 500)).toEqual(asked(orbits(kEven), 100));
  });

  it('MovingCamera_SeesATenthMore', () => {
    const { fovDeg } = asked(orbits(kEven), 50);
    expect(Math.tan((fovDeg * Math.PI) / 360)).toBeCloseTo(1.1 * Math.tan(Math.PI / 8), 9);
    const shifted = orbits(kEven).map((camera) => ({ ...camera, lensShiftX: 0.55 }));
    expect(asked(shifted, 50).lensShiftX).toBeCloseTo(0.5, 9);
    const wide = orbits(kEven).map((camera) => ({ ...camera, fovDeg: 120 }));
    expect(asked(wide, 50).fovDeg).toBe(120);
  });

  it.each([
    ['StillCamera', Array.from({ length: 12 }, () => 3)],
    ['FirstMove', [0, 3]],
    ['CameraThatStopped', [0, 1, 2, 3, 4, 4, 4, 4, 4]],
    ['CameraThatTurnedBack', [0, 1, 2, 3, 4, 3, 2, 1]],
    ['CameraThatJumped', [0, 0, 0, 0, 0, 0, 40]],
    ['CameraAfterAJump', [0, 0, 0, 40, 40, 40]],
  ])('%s_IsAskedForAsItIs', (_, degrees) => {
    expect(asked(orbits(degrees), 100)).toEqual(turned(degrees.at(-1) ?? 0));
  });

  it('FastZoom_EndsBeforeItsTarget', () => {
    const cameras = Array.from({ length: 8 }, (_, i) => ({ ...kBegin, eye: vec(0, 0, 8 * 0.5 ** i) }));
    expect(asked(cameras, 100).eye.z).toBeCloseTo((cameras.at(-1)?.eye.z ?? 0) * 0.75, 9);
  });

  it('AfterAPause_StartsAnew', () => {
    const askedCamera = new AskedCamera();
    for (let i = 0; i < 12; i += 1) askedCamera.of(turned(i), i * kFrameMs, 100);
    expect(askedCamera.of(turned(50), 5_000, 100)).toEqual(turned(50));
  });
});
