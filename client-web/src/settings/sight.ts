// What a camera sees of a scene's bounds. Pure.

import { add, cross, dot, length, normalize, scale, sub, vec, type Vec } from '../core/vec3';
import type { Bounds, CameraSettings } from './settings';

/** Of the picture that a fit leaves free around the scene. */
const kMargin = 1.05;
const kUp = vec(0, 1, 0);

export const centreOf = ({ min, max }: Bounds): Vec => scale(add(min, max), 0.5);
export const diagonalOf = ({ min, max }: Bounds): number => length(sub(max, min));

export function isInside({ min, max }: Bounds, point: Vec): boolean {
  const within = (axis: 'x' | 'y' | 'z'): boolean => point[axis] > min[axis] && point[axis] < max[axis];
  return within('x') && within('y') && within('z');
}

const cornersOf = ({ min, max }: Bounds): Vec[] =>
  [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => vec(x, y, z))));

interface Axes {
  readonly right: Vec;
  readonly up: Vec;
  readonly forward: Vec;
}

export function axesOf({ eye, target, up }: CameraSettings): Axes {
  const forward = normalize(sub(target, eye), vec(0, 0, -1));
  const right = normalize(cross(forward, up), vec(1, 0, 0));
  return { right, up: cross(right, forward), forward };
}

/** Metres that half the picture's height spans at a depth. */
export function halfHeightAt(camera: CameraSettings, depth: number): number {
  if (camera.orthographic) return camera.halfHeight;
  return depth * Math.tan((camera.fovDeg * Math.PI) / 360);
}

/**
 * Whether any of the bounds may be in the picture: no plane of the view's frustum has all corners
 * outside. `aspect`: width by height.
 */
export function sees(camera: CameraSettings, aspect: number, bounds: Bounds): boolean {
  const { forward, right, up } = axesOf(camera);
  const corners = cornersOf(bounds).map((corner) => {
    const from = sub(corner, camera.eye);
    const depth = dot(from, forward);
    const reach = halfHeightAt(camera, depth); // up and down at that depth
    const [shiftX, shiftY] = [camera.lensShiftX * reach * aspect, camera.lensShiftY * reach];
    return { x: dot(from, right) - shiftX, y: dot(from, up) - shiftY, depth, reach };
  });
  const outside = [
    corners.every(({ depth }) => depth <= 0),
    corners.every(({ x, reach }) => x > reach * aspect),
    corners.every(({ x, reach }) => x < -reach * aspect),
    corners.every(({ y, reach }) => y > reach),
    corners.every(({ y, reach }) => y < -reach),
  ];
  return !outside.includes(true);
}

/** The same camera, moved and not turned, so that all of the bounds is in the picture. */
export function fitted(camera: CameraSettings, aspect: number, bounds: Bounds): CameraSettings {
  const { forward, right, up } = axesOf({ ...camera, up: kUp });
  const centre = centreOf(bounds);
  const tan = halfHeightAt({ ...camera, orthographic: false }, 1);
  const corners = cornersOf(bounds).map((corner) => sub(corner, centre));
  const half = Math.max(...corners.map((c) => Math.max(Math.abs(dot(c, up)), Math.abs(dot(c, right)) / aspect)));
  const distance = camera.orthographic
    ? diagonalOf(bounds)
    : Math.max(
        ...corners.map((c) => {
          const across = Math.max(Math.abs(dot(c, up)), Math.abs(dot(c, right)) / aspect);
          return (across / tan) * kMargin - dot(c, forward);
        }),
      );
  return {
    ...camera,
    eye: sub(centre, scale(forward, Math.max(distance, 1e-6))),
    target: centre,
    up: kUp,
    halfHeight: camera.orthographic ? Math.max(half * kMargin, 1e-6) : camera.halfHeight,
    lensShiftX: 0,
    lensShiftY: 0,
  };
}
