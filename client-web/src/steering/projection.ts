// Where a point of the scene is on the picture, and back, as the server projects it.

import { add, cross, dot, normalize, scale, sub, vec, type Vec } from '../core/vec3';
import type { CameraSettings } from '../settings/settings';

/** x to the right and y up, both from -1 to 1 over the picture; depth in metres before the eye. */
export interface PicturePoint {
  readonly x: number;
  readonly y: number;
  readonly depth: number;
}

interface Axes {
  readonly right: Vec;
  readonly up: Vec;
  readonly forward: Vec;
}

function axesOf({ eye, target, up }: CameraSettings): Axes {
  const forward = normalize(sub(target, eye), vec(0, 0, -1));
  const right = normalize(cross(forward, up), vec(1, 0, 0));
  return { right, up: cross(right, forward), forward };
}

/** Metres that half the picture's height spans at a depth. */
export function halfHeightAt(camera: CameraSettings, depth: number): number {
  if (camera.orthographic) return camera.halfHeight;
  return depth * Math.tan((camera.fovDeg * Math.PI) / 360);
}

/** Null for what is not in front of the eye. `aspect`: width over height. */
export function project(camera: CameraSettings, aspect: number, point: Vec): PicturePoint | null {
  const { right, up, forward } = axesOf(camera);
  const from = sub(point, camera.eye);
  const depth = dot(from, forward);
  if (!(depth > 0)) return null;
  const half = halfHeightAt(camera, depth);
  return {
    x: dot(from, right) / (half * aspect) - camera.lensShiftX,
    y: dot(from, up) / half - camera.lensShiftY,
    depth,
  };
}

export function unproject(camera: CameraSettings, aspect: number, { x, y, depth }: PicturePoint): Vec {
  const { right, up, forward } = axesOf(camera);
  const half = halfHeightAt(camera, depth);
  const across = scale(right, (x + camera.lensShiftX) * half * aspect);
  const upwards = scale(up, (y + camera.lensShiftY) * half);
  return add(add(camera.eye, scale(forward, depth)), add(across, upwards));
}
