import { describe, expect, it } from 'vitest';

import { vec } from '../../src/core/vec3';
import { containedIn } from '../../src/core/size';
import { project, unproject } from '../../src/steering/projection';
import { sampleSettings } from '../sample';

const camera = sampleSettings({ eye: vec(0, 0, 0), target: vec(0, 0, -2), fovDeg: 90 });

describe('project', () => {
  it('Ahead_IsTheMiddle', () => {
    expect(project(camera, 2, vec(0, 0, -5))).toEqual({ x: 0, y: 0, depth: 5 });
  });

  it('EdgesOfTheView_AreOne', () => {
    const at = project(camera, 2, vec(10, 5, -5));
    expect(at?.x).toBeCloseTo(1);
    expect(at?.y).toBeCloseTo(1);
  });

  it('Behind_IsNowhere', () => {
    expect(project(camera, 2, vec(0, 0, 1))).toBeNull();
    expect(project(camera, 2, vec(1, 0, 0))).toBeNull();
  });

  it('LensShift_MovesTheMiddleOff', () => {
    const shifted = { ...camera, lensShiftX: 0.5, lensShiftY: -0.25 };
    expect(project(shifted, 2, vec(0, 0, -5))).toEqual({ x: -0.5, y: 0.25, depth: 5 });
  });

  it('Orthographic_HasOneScale', () => {
    const plan = { ...camera, orthographic: true, halfHeight: 4 };
    expect(project(plan, 1, vec(2, -4, -50))).toEqual({ x: 0.5, y: -1, depth: 50 });
  });

  it.each([false, true])('Unproject_TakesItBack_Orthographic%s', (orthographic) => {
    const tilted = {
      ...sampleSettings({ eye: vec(3, 2, 1), target: vec(-4, 1, 2), lensShiftX: 0.3 }),
      orthographic,
    };
    const point = vec(-2, 1.5, 0.75);
    const at = project(tilted, 1.6, point);
    expect(at).not.toBeNull();
    const back = at && unproject(tilted, 1.6, at);
    for (const axis of ['x', 'y', 'z'] as const) expect(back?.[axis]).toBeCloseTo(point[axis], 9);
  });
});

describe('containedIn', () => {
  it('WiderBox_HasBarsAtItsSides', () => {
    const box = { left: 10, top: 20, width: 400, height: 100 };
    expect(containedIn(box, { width: 200, height: 100 })).toEqual({
      left: 110,
      top: 20,
      width: 200,
      height: 100,
    });
  });
});
