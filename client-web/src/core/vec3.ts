// The few vector operations that the camera needs; plain objects, as the protocol's Vec3.

export interface Vec {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

export const vec = (x: number, y: number, z: number): Vec => ({ x, y, z });
export const add = (a: Vec, b: Vec): Vec => vec(a.x + b.x, a.y + b.y, a.z + b.z);
export const sub = (a: Vec, b: Vec): Vec => vec(a.x - b.x, a.y - b.y, a.z - b.z);
export const scale = (a: Vec, s: number): Vec => vec(a.x * s, a.y * s, a.z * s);
export const dot = (a: Vec, b: Vec): number => a.x * b.x + a.y * b.y + a.z * b.z;
export const length = (a: Vec): number => Math.hypot(a.x, a.y, a.z);
export const cross = (a: Vec, b: Vec): Vec =>
  vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);

/** Unit vector along `a`; `fallback` where `a` has no direction. */
export function normalize(a: Vec, fallback: Vec): Vec {
  const l = length(a);
  return l > 1e-12 ? scale(a, 1 / l) : fallback;
}

export const equal = (a: Vec, b: Vec): boolean => a.x === b.x && a.y === b.y && a.z === b.z;
