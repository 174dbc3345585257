// Paths that every scene has. The same as server/path/built_in_paths.cpp; protocol/vectors/paths.json keeps both equal.

import { add, length, normalize, scale, sub, vec, type Vec } from '../core/vec3';
import { kMaxKeys, type PathKeys, type View } from './camera_path';
import { evenly } from './path_file';

/** Of a scene, in metres. */
export interface Box {
  readonly min: Vec;
  readonly max: Vec;
}

const kTurntableKeys = 24; // within 1.2e-4 of its radius of a circle
const kUp = vec(0, 1, 0);

/** Once round what the view looks at, at its height and distance, at a constant speed. */
export function turntable(first: View, seconds: number): PathKeys {
  const { target, fovDeg } = first;
  const from = sub(first.eye, target);
  const begin = Math.atan2(from.x, from.z);
  // Of a camera that looks straight down: about its own axis is no way at all.
  const around = Math.max(Math.hypot(from.x, from.z), 1e-3 * length(from));
  const keys = evenly(kTurntableKeys, seconds, true).map((atS) => {
    const angle = begin + (2 * Math.PI * atS) / seconds;
    const eye = add(target, vec(around * Math.sin(angle), from.y, around * Math.cos(angle)));
    return { atS, eye, target, up: kUp, fovDeg };
  });
  return { keys, seconds, constantSpeed: true, loop: true };
}

/** How far the eye may go along its way until it leaves the box. */
function wayThrough({ min, max }: Box, eye: Vec, ahead: Vec): number {
  const ways = (['x', 'y', 'z'] as const).flatMap((axis) => {
    const end = ahead[axis] > 0 ? max[axis] : min[axis];
    return Math.abs(ahead[axis]) > 1e-6 ? [(end - eye[axis]) / ahead[axis]] : [];
  });
  return Math.max(Math.min(...ways), 0);
}

/**
 * Through the scene's cameras in their order, or, with fewer than two, from `first` along the way that it looks, to the
 * other side of the scene.
 */
export function flythrough(cameras: readonly View[], bounds: Box | null, first: View, seconds: number): PathKeys {
  let stops = cameras.slice(0, kMaxKeys);
  if (stops.length < 2) {
    const toward = sub(first.target, first.eye);
    const ahead = normalize(toward, vec(0, 0, -1));
    const way = bounds ? wayThrough(bounds, first.eye, ahead) : 0;
    const by = scale(ahead, way > 0 ? 0.9 * way : length(toward) / 2);
    stops = [first, { ...first, eye: add(first.eye, by), target: add(first.target, by) }];
  }
  const times = evenly(stops.length, seconds, false);
  const keys = stops.map(({ eye, target, up, fovDeg }, i) => ({ atS: times[i] ?? 0, eye, target, up, fovDeg }));
  return { keys, seconds, constantSpeed: false, loop: false };
}
