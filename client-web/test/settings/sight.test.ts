import { describe, expect, it } from 'vitest';

import { vec } from '../../src/core/vec3';
import type { CameraSettings } from '../../src/settings/settings';
import { fitted, isInside, sees } from '../../src/settings/sight';
import { kBounds } from '../sample'; // 20 x 8 x 10 m

const kCamera: CameraSettings = {
  eye: vec(0, 4, 40),
  target: vec(0, 4, 0),
  up: vec(0, 1, 0),
  fovDeg: 60,
  halfHeight: 5,
  orthographic: false,
  lensShiftX: 0,
  lensShiftY: 0,
};
const k16x9 = 16 / 9;

describe('sees', () => {
  const seen = (change: Partial<CameraSettings>): boolean => sees({ ...kCamera, ...change }, k16x9, kBounds);

  it('WhatIsBefore_Beside_Behind', () => {
    expect(seen({})).toBe(true);
    expect(seen({ target: vec(0, 4, 80) })).toBe(false);
    expect(seen({ target: vec(40, 4, 40) })).toBe(false);
    expect(seen({ target: vec(0, 44, 40) })).toBe(false);
    expect(seen({ eye: vec(1e6, 4, 40), target: vec(1e6, 4, 0) })).toBe(false);
  });

  it('FromInside_AlwaysSeesSomething', () => {
    for (const target of [vec(9, 4, 0), vec(-9, 4, 0), vec(0, 50, 0), vec(0, 4, 90)]) {
      expect(seen({ eye: vec(0, 4, 0), target })).toBe(true);
    }
  });

  it('Orthographic_ByItsHeight', () => {
    const above = { orthographic: true, eye: vec(0, 20, 40), target: vec(0, 20, 0) };
    expect(seen({ ...above, halfHeight: 5 })).toBe(false);
    expect(seen({ ...above, halfHeight: 15 })).toBe(true);
  });

  it('ShiftedLens_SeesBesideItsAxis', () => {
    const aside = { eye: vec(60, 4, 40), target: vec(60, 4, 0) };
    expect(seen(aside)).toBe(false);
    expect(seen({ ...aside, lensShiftX: -1.5 })).toBe(true);
  });
});

describe('fitted', () => {
  /** Of each corner of the bounds, how far out it is in the picture: 1 is its edge. */
  function reach(camera: CameraSettings, aspect: number): number {
    const { min, max } = kBounds;
    const tan = Math.tan((camera.fovDeg * Math.PI) / 360);
    let most = 0;
    for (const x of [min.x, max.x]) {
      for (const y of [min.y, max.y]) {
        for (const z of [min.z, max.z]) {
          const half = camera.orthographic ? camera.halfHeight : (camera.eye.z - z) * tan;
          expect(half).toBeGreaterThan(0);
          most = Math.max(most, Math.abs(x - camera.eye.x) / half / aspect, Math.abs(y - camera.eye.y) / half);
        }
      }
    }
    return most;
  }

  it.each([
    ['perspective, wide', false, k16x9],
    ['perspective, tall', false, 0.5],
    ['orthographic, wide', true, k16x9],
    ['orthographic, tall', true, 0.5],
  ])('%s_FillsThePictureAndNoMore', (_, orthographic, aspect) => {
    const camera = fitted({ ...kCamera, orthographic }, aspect, kBounds);
    expect(camera.target).toEqual(vec(0, 4, 0));
    expect(reach(camera, aspect)).toBeLessThanOrEqual(1);
    expect(reach(camera, aspect)).toBeGreaterThan(0.93);
  });

  it('Turned_KeepsItsSide', () => {
    const { eye, target } = fitted({ ...kCamera, eye: vec(40, 44, 0), target: vec(0, 4, 0) }, k16x9, kBounds);
    expect(eye.x - target.x).toBeCloseTo(eye.y - target.y, 9);
    expect(eye.z).toBeCloseTo(target.z, 9);
  });
});

describe('isInside', () => {
  it('TheWallsAreOutside', () => {
    expect(isInside(kBounds, vec(0, 4, 0))).toBe(true);
    expect(isInside(kBounds, vec(10, 4, 0))).toBe(false);
    expect(isInside(kBounds, vec(0, 9, 0))).toBe(false);
  });
});
