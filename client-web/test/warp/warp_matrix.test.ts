import { describe, expect, it } from 'vitest';

import { add, vec, type Vec } from '../../src/core/vec3';
import type { CameraSettings } from '../../src/settings/settings';
import { project } from '../../src/steering/projection';
import { warpCamera, warpCameraOf, warped, warpMatrix, type WarpCamera } from '../../src/warp/warp_matrix';
import { sampleSettings } from '../sample';

const kAspect = 16 / 9;
const kPoints: readonly Vec[] = [vec(0, 0, -3), vec(1, -0.5, -7), vec(-2, 1, -20), vec(0.3, 0.2, -0.8)];

function camera(eye: Vec, target: Vec, change: Partial<CameraSettings> = {}): CameraSettings {
  return { ...sampleSettings({ eye, target, fovDeg: 60 }), orthographic: false, up: vec(0, 1, 0), ...change };
}

function inPerspective(settings: CameraSettings): WarpCamera {
  const made = warpCameraOf(settings);
  if (!made) throw new Error('orthographic');
  return made;
}

/** Each point's place in both views, by the matrix and by projection. */
function expectSame(from: CameraSettings, to: CameraSettings, origin = vec(0, 0, 0)): void {
  const matrix = warpMatrix(inPerspective(from), inPerspective(to), kAspect, 2);
  for (const point of kPoints.map((p) => add(p, origin))) {
    const seen = project(from, kAspect, point);
    const expected = project(to, kAspect, point);
    if (!seen || !expected) throw new Error('behind the eye');
    const at = warped(matrix, seen.x, seen.y, 1 / seen.depth);
    expect(at?.x).toBeCloseTo(expected.x, 4); // a hundredth of a pixel
    expect(at?.y).toBeCloseTo(expected.y, 4);
  }
}

describe('warpMatrix', () => {
  const from = camera(vec(0, 0, 0), vec(0, 0, -5));

  it('SameCamera_MovesNothing', () => expectSame(from, from));

  it('Turned_MovesAsTheViewDoes', () => expectSame(from, camera(vec(0, 0, 0), vec(0.5, 0.2, -5))));

  it('Shifted_MovesByDepth', () => expectSame(from, camera(vec(0.1, -0.05, -0.2), vec(0.1, 0, -5))));

  it('LensShiftAndFieldOfView_Count', () => {
    const shifted = camera(vec(0.1, 0, 0), vec(0, 0, -5), { lensShiftX: 0.4, lensShiftY: -0.2, fovDeg: 40 });
    expectSame(shifted, from);
    expectSame(from, shifted);
  });

  it('AThousandKilometresFromTheOrigin_HoldsAsWell', () => {
    const origin = vec(1e6, -1e6, 1e6);
    const at = (v: Vec): Vec => add(v, origin);
    expectSame(camera(at(vec(0, 0, 0)), at(vec(0, 0, -5))), camera(at(vec(0.1, 0, 0)), at(vec(0.2, 0, -5))), origin);
  });

  it('Sky_OnlyTurns', () => {
    const matrix = warpMatrix(inPerspective(from), inPerspective(camera(vec(3, 1, 2), vec(3, 1, -8))), kAspect, 2);
    expect(warped(matrix, 0.3, -0.4, 0)?.x).toBeCloseTo(0.3, 6);
  });

  it('BehindTheEye_IsNowhere', () => {
    const matrix = warpMatrix(inPerspective(from), inPerspective(camera(vec(0, 0, -5), vec(0, 0, -9))), kAspect, 2);
    expect(warped(matrix, 0, 0, 1 / 3)).toBeNull();
  });

  it('Nearer_IsInFrontOfFarther', () => {
    const matrix = warpMatrix(inPerspective(from), inPerspective(from), kAspect, 2);
    const depth = (w: number): number => ((matrix[10] ?? 0) * w + (matrix[14] ?? 0)) / (matrix[15] ?? 1);
    expect(depth(0)).toBeCloseTo(1, 6);
    expect([2, 1, 0.1].map(depth)).toEqual([2, 1, 0.1].map(depth).sort((a, b) => a - b));
    expect(depth(2)).toBeGreaterThan(-1);
  });
});

it('Orthographic_HasNone', () => {
  expect(warpCameraOf(camera(vec(0, 0, 0), vec(0, 0, -1), { orthographic: true }))).toBeNull();
});

it('CameraOfAPicture_LooksAlongUpTimesRight', () => {
  const made = warpCamera({ eye: vec(0, 0, 0), right: vec(1, 0, 0), up: vec(0, 1, 0), halfHeight: 1, lensShiftX: 0, lensShiftY: 0 });
  expect(made.forward).toEqual(vec(0, 0, -1));
});
