// Where a file is seen from and what lights it: the same numbers for every renderer.

import { add, length, normalize, scale, sub, vec, type Vec } from '../src/core/vec3';

export interface Size {
  readonly width: number; // px
  readonly height: number;
}

export interface Sphere {
  readonly center: Vec; // m, world
  readonly radius: number;
}

/** The y axis is up. */
export interface View {
  readonly eye: Vec; // m, world
  readonly target: Vec;
  readonly fovDeg: number; // vertical, all of it
}

/** A point light, as a light set has it. */
export interface Lamp {
  readonly id: number;
  readonly position: Vec; // m, world
  readonly color: Vec; // linear
  readonly intensity: number; // cd
  readonly radiusM: number; // where it reaches exactly 0
}

export interface Light {
  readonly lamps: readonly Lamp[];
  readonly exposure: number;
}

/** The near plane of a view that `froxel render --camera` is given, m. */
export const kNear = 0.05;

const kFovDeg = 45;
const kForward = vec(0, 0, 1);

/** Through the corners of a box, as `froxel info` has it. */
export function sphereOf(min: Vec, max: Vec): Sphere {
  return { center: scale(add(min, max), 0.5), radius: length(sub(max, min)) / 2 };
}

/** All of a sphere, from above the front right, in pictures that are at least as wide as high. */
export function overview(sphere: Sphere): View {
  const distance = (1.05 * sphere.radius) / Math.sin(((kFovDeg / 2) * Math.PI) / 180);
  if (distance - sphere.radius < kNear) {
    throw new Error(`a radius of ${sphere.radius} m is too small: parts are nearer than ${kNear} m`);
  }
  const toEye = normalize(vec(0.5, 0.35, 1), kForward);
  return { eye: add(sphere.center, scale(toEye, distance)), target: sphere.center, fovDeg: kFovDeg };
}

/** No part of the sphere is farther from the eye, m. */
export const farthest = (view: View, sphere: Sphere): number =>
  length(sub(view.eye, sphere.center)) + sphere.radius;

interface Stand {
  readonly toward: Vec; // from the sphere's centre, of any length
  readonly color: Vec;
  readonly irradiance: number; // at the centre, facing the lamp
}

const kStands: readonly Stand[] = [
  { toward: vec(-0.5, 0.9, 1), color: vec(1, 1, 1), irradiance: 3 },
  { toward: vec(1, 0.2, 0.4), color: vec(0.6, 0.75, 1), irradiance: 1 },
  { toward: vec(0.3, 0.5, -1), color: vec(1, 0.8, 0.6), irradiance: 2 },
];

const kMostIntensity = 1e6; // of a lamp of a light set, cd

/** Three lamps around a sphere; whatever its size, its centre is exposed equally. */
export function lightAround({ center, radius }: Sphere): Light {
  const distance = 3 * radius;
  const most = Math.max(...kStands.map(({ irradiance }) => irradiance)) * distance ** 2;
  const dimmed = Math.min(1, kMostIntensity / most);
  const lamps = kStands.map(({ toward, color, irradiance }, index) => ({
    id: index + 1,
    position: add(center, scale(normalize(toward, kForward), distance)),
    color,
    intensity: irradiance * distance ** 2 * dimmed,
    radiusM: 10_000, // the most that a light set takes
  }));
  return { lamps, exposure: 1 / dimmed };
}

const text = ({ x, y, z }: Vec): string => `${x},${y},${z}`;

/** What `--camera` takes. */
export const cameraText = ({ eye, target, fovDeg }: View): string =>
  `${text(eye)};${text(target)};${fovDeg}`;
