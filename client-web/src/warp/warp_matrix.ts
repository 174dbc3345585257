// From a picture's pixels and their inverse distances to the view of another camera (McMillan,
// Bishop 1995, "Plenoptic Modeling"). In doubles and relative to the picture's eye, so that it holds
// far from the scene's origin too. Pure.

import { cross, dot, sub, type Vec } from '../core/vec3';
import type { CameraSettings } from '../settings/settings';
import { axesOf, halfHeightAt } from '../settings/sight';

/** In perspective. */
export interface WarpCamera {
  readonly eye: Vec; // metres
  readonly right: Vec; // unit vectors
  readonly up: Vec;
  readonly forward: Vec;
  readonly halfHeight: number; // of the picture a metre ahead
  readonly lensShiftX: number; // half pictures
  readonly lensShiftY: number;
}

/** `right` and `up` as a picture's header has them. */
export function warpCamera(camera: Omit<WarpCamera, 'forward'>): WarpCamera {
  return { ...camera, forward: cross(camera.up, camera.right) };
}

/** Null: it is orthographic. */
export function warpCameraOf(camera: CameraSettings): WarpCamera | null {
  if (camera.orthographic) return null;
  const { eye, lensShiftX, lensShiftY } = camera;
  return { eye, ...axesOf(camera), halfHeight: halfHeightAt(camera, 1), lensShiftX, lensShiftY };
}

/** Of the distance of the nearest vertex: what comes nearer to the eye is clipped. */
const kNearShare = 0.02;

/**
 * By column, for WebGL: takes (x, y, w, 1) to clip space, x and y from -1 to 1 over the picture, w
 * the inverse distance there in 1/m. It is linear in w, so that sky (w = 0) only turns.
 * `nearestPerM`: the largest w.
 */
export function warpMatrix(from: WarpCamera, to: WarpCamera, aspect: number, nearestPerM: number): Float32Array<ArrayBuffer> {
  const near = nearestPerM > 0 ? kNearShare / nearestPerM : 1;
  const column = (v: Vec): [number, number, number, number] => {
    const ahead = dot(v, to.forward);
    return [
      dot(v, to.right) / (aspect * to.halfHeight) - to.lensShiftX * ahead,
      dot(v, to.up) / to.halfHeight - to.lensShiftY * ahead,
      ahead,
      ahead,
    ];
  };
  const right = column(from.right).map((c) => c * aspect * from.halfHeight);
  const up = column(from.up).map((c) => c * from.halfHeight);
  const middle = column(from.forward);
  const ahead = middle.map((c, i) => c + (right[i] ?? 0) * from.lensShiftX + (up[i] ?? 0) * from.lensShiftY);
  const moved = column(sub(from.eye, to.eye));
  moved[2] -= 2 * near; // 1 far away and less where it is nearer
  return new Float32Array([...right, ...up, ...moved, ...ahead]);
}

export interface Warped {
  readonly x: number;
  readonly y: number;
  readonly w: number; // 1/m
}

/** A point of the picture in the other view: x and y from -1 to 1, and its inverse distance; null: behind the eye. */
export function warped(matrix: Float32Array, x: number, y: number, w: number): Warped | null {
  const row = (i: number): number =>
    (matrix[i] ?? 0) * x + (matrix[4 + i] ?? 0) * y + (matrix[8 + i] ?? 0) * w + (matrix[12 + i] ?? 0);
  const depth = row(3);
  return depth > 0 ? { x: row(0) / depth, y: row(1) / depth, w: w / depth } : null;
}
