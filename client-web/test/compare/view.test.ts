import { describe, expect, it } from 'vitest';

import { cameraText, farthest, lightAround, overview, sphereOf, type Sphere } from '../../compare/view';
import { dot, length, scale, sub, vec } from '../../src/core/vec3';

const kSphere: Sphere = { center: vec(10, -2, 3), radius: 0.5 };
const angleDeg = (cosine: number): number => (Math.acos(cosine) * 180) / Math.PI;

describe('view', () => {
  it('SphereOf_ABox_GoesThroughItsCorners', () => {
    const sphere = sphereOf(vec(-1, 0, 2), vec(1, 4, 6));
    expect(sphere.center).toEqual(vec(0, 2, 4));
    expect(sphere.radius).toBeCloseTo(Math.sqrt(1 + 4 + 4), 12);
  });

  it.each([0.05, 1, 4000])('Overview_OfARadiusOf_%d_HasItAllWithLittleToSpare', (radius) => {
    const view = overview({ ...kSphere, radius });
    const distance = length(sub(view.eye, kSphere.center));
    const seenDeg = (2 * Math.asin(radius / distance) * 180) / Math.PI;
    expect(seenDeg).toBeLessThan(view.fovDeg);
    expect(seenDeg).toBeGreaterThan(0.9 * view.fovDeg);
    expect(farthest(view, { ...kSphere, radius })).toBeCloseTo(distance + radius, 6);
  });

  it('Overview_OfWhatTheNearPlaneWouldCut_IsRefused', () => {
    expect(() => overview({ ...kSphere, radius: 0.02 })).toThrow('0.02 m is too small');
  });

  it('CameraText_HasEyeTargetAndAngle', () => {
    expect(cameraText({ eye: vec(1, 2.5, -3), target: vec(0, 0, 0), fovDeg: 45 })).toBe('1,2.5,-3;0,0,0;45');
  });
});

describe('light', () => {
  it.each([0.1, 1, 100, 1e4])('Lamps_AroundARadiusOf_%d_ExposeTheCentreEqually', (radius) => {
    const { lamps, exposure } = lightAround({ ...kSphere, radius });
    const exposed = lamps.map(
      ({ position, intensity }) => (exposure * intensity) / length(sub(position, kSphere.center)) ** 2,
    );
    expect(exposed.map((value) => value.toFixed(6))).toEqual(['3.000000', '1.000000', '2.000000']);
    expect(Math.max(...lamps.map(({ intensity }) => intensity))).toBeLessThanOrEqual(1e6); // cd, of a light set
  });

  it('Lamps_StandOutsideTheSphere_ApartFromEachOther', () => {
    const directions = lightAround(kSphere).lamps.map(({ position }) => {
      const away = sub(position, kSphere.center);
      expect(length(away)).toBeGreaterThan(kSphere.radius);
      return scale(away, 1 / length(away));
    });
    directions.forEach((a, i) => {
      for (const b of directions.slice(i + 1)) expect(angleDeg(dot(a, b))).toBeGreaterThan(60);
    });
  });
});
