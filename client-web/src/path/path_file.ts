// Camera paths as JSON: files, and what an address has. server/path/path_file.h describes the format.

import { equal, length, sub, vec, type Vec } from '../core/vec3';
import { kMaxKeys, problemOf, type Key, type PathKeys } from './camera_path';

const kUp = vec(0, 1, 0);
const kUsualFovDeg = 45;
const kMembers = ['seconds', 'constant_speed', 'loop', 'keys'];
const kKeyMembers = ['at_s', 'eye', 'target', 'up', 'fov_deg'];

interface Range {
  readonly min: number;
  readonly max: number;
}
const kSeconds: Range = { min: 0, max: 3600 };
const kPosition: Range = { min: -1e7, max: 1e7 };
const kFovDeg: Range = { min: 1, max: 170 };

const kFocus: Range = { min: 1e-6, max: 1e8 };
const kUpLength: Range = { min: 1e-6, max: 1e8 };

type Json = Record<string, unknown>;

const isObject = (value: unknown): value is Json =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

const textOf = (value: unknown): string => (value === undefined ? 'missing' : JSON.stringify(value)).slice(0, 60);

function numberOf(value: unknown, name: string, { min, max }: Range): number {
  if (typeof value === 'number' && value >= min && value <= max) return value;
  throw new Error(`${name} is ${textOf(value)}; it must be a number from ${min} to ${max}`);
}

function booleanOf(value: unknown, name: string): boolean {
  if (typeof value === 'boolean') return value;
  throw new Error(`${name} is ${textOf(value)}; it must be true or false`);
}

function placeOf(value: unknown, name: string): Vec {
  if (!Array.isArray(value) || value.length !== 3) throw new Error(`${name} is ${textOf(value)}; it must be three numbers`);
  const [x, y, z] = value.map((axis, i) => numberOf(axis, `${name}[${i}]`, kPosition));
  return vec(x ?? 0, y ?? 0, z ?? 0);
}

function checkLength(metres: number, name: string, what: string, { min, max }: Range): void {
  if (metres >= min && metres <= max) return;
  throw new Error(`${name} is ${metres} m ${what}; it must be ${min} to ${max}`);
}

function onlyMembers(object: Json, path: string, names: readonly string[]): void {
  const other = Object.keys(object).find((name) => !names.includes(name));
  if (other !== undefined) throw new Error(`${path}${other.slice(0, 60)} is not a member of a camera path`);
}

function keyOf(json: unknown, name: string): Omit<Key, 'atS'> & { readonly atS: number | null } {
  if (!isObject(json)) throw new Error(`${name} is ${textOf(json)}; it must be an object`);
  onlyMembers(json, `${name}.`, kKeyMembers);
  for (const needed of ['eye', 'target']) if (!(needed in json)) throw new Error(`${name}.${needed} is missing`);
  const [eye, target] = [placeOf(json.eye, `${name}.eye`), placeOf(json.target, `${name}.target`)];
  checkLength(length(sub(eye, target)), `${name}.target`, 'from the eye', kFocus);
  const up = 'up' in json ? placeOf(json.up, `${name}.up`) : kUp;
  checkLength(length(up), `${name}.up`, 'long', kUpLength);
  return {
    eye,
    target,
    up,
    fovDeg: 'fov_deg' in json ? numberOf(json.fov_deg, `${name}.fov_deg`, kFovDeg) : kUsualFovDeg,
    atS: 'at_s' in json ? numberOf(json.at_s, `${name}.at_s`, kSeconds) : null,
  };
}

/** When each of so many keys is due where none says so. */
export const evenly = (count: number, seconds: number, loop: boolean): number[] =>
  Array.from({ length: count }, (_, i) => (count > 1 ? (seconds * i) / (loop ? count : count - 1) : 0));

/** Throws, with the name of the member, its value and what would be right. */
export function parsePath(text: string): PathKeys {
  let json: unknown = null;
  try {
    json = JSON.parse(text);
  } catch {
    // said below
  }
  if (!isObject(json) || !Array.isArray(json.keys)) {
    throw new Error('expected a JSON object with a list of keys');
  }
  onlyMembers(json, '', kMembers);
  const constantSpeed = 'constant_speed' in json && booleanOf(json.constant_speed, 'constant_speed');
  const loop = 'loop' in json && booleanOf(json.loop, 'loop');
  const read = json.keys.slice(0, kMaxKeys + 1).map((key, i) => keyOf(key, `keys[${i}]`));
  const seconds = 'seconds' in json ? numberOf(json.seconds, 'seconds', kSeconds) : (read.at(-1)?.atS ?? 0);
  const timed = read.filter(({ atS }) => atS !== null).length;
  if (timed !== 0 && timed !== read.length) throw new Error(`keys: ${timed} of ${read.length} have at_s; expected all or none`);
  const times = evenly(read.length, seconds, loop);
  const path = {
    keys: read.map((key, i) => ({ ...key, atS: key.atS ?? times[i] ?? 0 })),
    seconds,
    constantSpeed,
    loop,
  };
  const problem = problemOf(path);
  if (problem !== '') throw new Error(problem);
  return path;
}

/** A hundredth of a millimetre at 100 m. */
const kDigits = 7;
const short = (value: number): number => Number(value.toPrecision(kDigits));
const listOf = ({ x, y, z }: Vec): number[] => [x, y, z].map(short);

/** What is as usual is left out. */
export function jsonOf({ keys, seconds, constantSpeed, loop }: PathKeys): Json {
  return {
    seconds,
    ...(constantSpeed && { constant_speed: true }),
    ...(loop && { loop: true }),
    keys: keys.map(({ atS, eye, target, up, fovDeg }) => ({
      at_s: short(atS),
      eye: listOf(eye),
      target: listOf(target),
      ...(!equal(up, kUp) && { up: listOf(up) }),
      fov_deg: short(fovDeg),
    })),
  };
}

export const pathText = (path: PathKeys): string => `${JSON.stringify(jsonOf(path), null, 1)}\n`;
/** As it is in an address. */
export const pathLine = (path: PathKeys): string => JSON.stringify(jsonOf(path));
