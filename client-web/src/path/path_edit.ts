// Changes of a camera path as pure functions: path in, path out. Who shows the result asks problemOf() first.

import { CameraPath, kMaxKeys, type Key, type PathKeys, type View } from './camera_path';

/** From one key to the next that is added. */
export const kStepS = 2;

export const kNoPath: PathKeys = { keys: [], seconds: 0, constantSpeed: false, loop: false };

const keyOf = ({ eye, target, up, fovDeg }: View, atS: number): Key => ({ atS, eye, target, up, fovDeg });

/** Where the path is at a key. */
export function timeOfKey(path: CameraPath, index: number): number {
  return path.keys.constantSpeed ? path.evenTimeOf(index) : (path.keys.keys[index]?.atS ?? 0);
}

/** Between two keys where `timeS` is, else after the last one; and which key it is. */
export function withKey(path: PathKeys, view: View, timeS: number): { path: PathKeys; index: number } {
  const { keys, seconds, constantSpeed } = path;
  if (keys.length >= kMaxKeys) throw new Error(`the path has ${kMaxKeys} keys; it may have no more`);
  const last = keys.at(-1);
  if (!last) return { path: { ...path, keys: [keyOf(view, 0)], seconds: 0 }, index: 0 };
  const next = constantSpeed ? keyAfterWay(path, timeS) : keys.findIndex(({ atS }) => atS > timeS);
  if (next <= 0) {
    const atS = last.atS + kStepS;
    const rest = seconds - last.atS; // a loop's way back, or a pause at the end
    const whole = path.loop && keys.length === 1 ? atS + kStepS : atS + rest;
    return { path: { ...path, keys: [...keys, keyOf(view, atS)], seconds: whole }, index: keys.length };
  }
  const [before, after] = [keys[next - 1]?.atS ?? 0, keys[next]?.atS ?? 0];
  const isFree = !constantSpeed && timeS > before;
  const added = keyOf(view, isFree ? timeS : (before + after) / 2);
  return { path: { ...path, keys: [...keys.slice(0, next), added, ...keys.slice(next)] }, index: next };
}

/** The first key after that time at a constant speed; -1: none. */
function keyAfterWay(path: PathKeys, timeS: number): number {
  const made = new CameraPath(path);
  return path.keys.findIndex((_, i) => timeOfKey(made, i) > timeS);
}

export const withView = (path: PathKeys, index: number, view: View): PathKeys => ({
  ...path,
  keys: path.keys.map((key, i) => (i === index ? keyOf(view, key.atS) : key)),
});

/** Without its last key there is no path. */
export function withoutKey(path: PathKeys, index: number): PathKeys {
  const keys = path.keys.filter((_, i) => i !== index);
  const isLast = index === keys.length && !path.loop;
  return { ...path, keys, seconds: isLast ? (keys.at(-1)?.atS ?? 0) : path.seconds };
}

/** The least time between two keys. */
const kLeastS = 0.01;
const hundredths = (value: number): number => Math.round(value * 100) / 100;

/** Between its neighbours; the last one of a path that does not go round takes the end with it. */
export function withTime(path: PathKeys, index: number, timeS: number): PathKeys {
  const { keys, loop, seconds } = path;
  const before = keys[index - 1]?.atS;
  const after = keys[index + 1]?.atS ?? (loop ? seconds : Infinity);
  const least = before === undefined ? 0 : before + kLeastS;
  const atS = Math.max(least, Math.min(after - kLeastS, hundredths(timeS)));
  const moved = keys.map((key, i) => (i === index ? { ...key, atS } : key));
  return { ...path, keys: moved, seconds: index === keys.length - 1 && !loop ? atS : seconds };
}

/** All in proportion. */
export function withSeconds(path: PathKeys, seconds: number): PathKeys {
  const factor = path.seconds > 0 ? seconds / path.seconds : 0;
  return { ...path, seconds, keys: path.keys.map((key) => ({ ...key, atS: key.atS * factor })) };
}

/** A loop needs time for the way back; without it the path ends at its last key. */
export function withLoop(path: PathKeys, loop: boolean): PathKeys {
  const { keys } = path;
  const last = keys.at(-1)?.atS ?? 0;
  const step = keys.length > 1 ? last / (keys.length - 1) : 0;
  return { ...path, loop, seconds: last + (loop ? step : 0) };
}
