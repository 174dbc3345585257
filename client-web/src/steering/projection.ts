// Where a point of the scene is on the picture, and back, as the server projects it.

import { add, dot, scale, sub, type Vec } from '../core/vec3';
import type { CameraSettings } from '../settings/settings';
import { axesOf, halfHeightAt } from '../settings/sight';

/** x to the right and y up, both from -1 to 1 over the picture; depth in metres before the eye. */
export interface PicturePoint {
  readonly x: number;
  readonly y: number;
  readonly depth: number;
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
