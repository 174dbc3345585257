// A camera that moves through key frames. The same maths as server/path/camera_path.cpp, which gives its sources;
// protocol/vectors/paths.json keeps both equal.

import { add, cross, equal, length, normalize, scale, sub, vec, type Vec } from '../core/vec3';

/** A camera in perspective: metres, world; full vertical angle in degrees. */
export interface View {
  readonly eye: Vec;
  readonly target: Vec;
  readonly up: Vec;
  readonly fovDeg: number;
}

export interface Key extends View {
  readonly atS: number;
}

export interface PathKeys {
  readonly keys: readonly Key[];
  readonly seconds: number; // of all; at least the last key's time
  readonly constantSpeed: boolean; // of the eye; the keys' times count for nothing
  readonly loop: boolean; // goes on to the first key, where it is after `seconds`
}

export const kMaxKeys = 1000;
const kLeastStepS = 1e-6; // from one key to the next

const kSteps = 64; // of a segment's length

/** With its ends' slopes a cubic's way from x = 0 to 1, where it is 0 and `end`. */
const hermite = (x: number, slope0: number, slope1: number, end: number): number =>
  x * (slope0 + x * (3 * end - 2 * slope0 - slope1 + x * (slope0 + slope1 - 2 * end)));

const clamp = (value: number, least: number, most: number): number => Math.max(least, Math.min(most, value));
const mix = (a: number, b: number, share: number): number => a * (1 - share) + b * share;
const distance = (a: Vec, b: Vec): number => length(sub(a, b));
/** What is nearer has no length in doubles. */
const apart = (a: Vec, b: Vec): boolean => distance(a, b) > 0;
/** Where a path ends, or rests, it goes on as if it were mirrored. */
const mirrored = (end: Vec, before: Vec): Vec => add(end, sub(end, before));

/** Of the eye, between two keys. */
class Segment {
  private readonly terms: readonly [Vec, Vec, Vec, Vec]; // of 1, u, u² and u³, u from 0 to 1
  private readonly lengths: number[] = [0]; // metres from its begin, at even steps of u; one alone: it has no length

  /** Between the second and the third of these points. */
  constructor(before: Vec, begin: Vec, end: Vec, after: Vec) {
    const none = vec(0, 0, 0);
    this.terms = [begin, none, none, none];
    if (!apart(begin, end)) return;
    // Knots are the square roots of the distances apart; the slopes are of u.
    const k0 = Math.sqrt(distance(before, begin));
    const k1 = Math.sqrt(distance(begin, end));
    const k2 = Math.sqrt(distance(end, after));
    const way = sub(end, begin);
    const slope0 = scale(
      add(sub(scale(sub(begin, before), 1 / k0), scale(sub(end, before), 1 / (k0 + k1))), scale(way, 1 / k1)),
      k1,
    );
    const slope1 = scale(
      add(sub(scale(way, 1 / k1), scale(sub(after, begin), 1 / (k1 + k2))), scale(sub(after, end), 1 / k2)),
      k1,
    );
    this.terms = [
      begin,
      slope0,
      sub(sub(scale(way, 3), scale(slope0, 2)), slope1),
      sub(add(slope0, slope1), scale(way, 2)),
    ];
    for (let step = 0; step < kSteps; step += 1) {
      const u = step / kSteps;
      const simpson = this.speedAt(u) + 4 * this.speedAt(u + 0.5 / kSteps) + this.speedAt(u + 1 / kSteps);
      this.lengths.push((this.lengths[step] ?? 0) + simpson / kSteps / 6);
    }
  }

  get length(): number {
    return this.lengths.at(-1) ?? 0;
  }

  at(u: number): Vec {
    const [c0, c1, c2, c3] = this.terms;
    return add(c0, scale(add(c1, scale(add(c2, scale(c3, u)), u)), u));
  }

  /** u where the eye is so many metres from the begin. */
  placeOf(way: number): number {
    if (this.length === 0) return 0;
    let step = 0;
    while (step + 1 < kSteps && way >= (this.lengths[step + 1] ?? 0)) step += 1;
    const begin = this.lengths[step] ?? 0;
    const part = (this.lengths[step + 1] ?? 0) - begin;
    const u = step / kSteps;
    const x = part > 0 ? clamp((way - begin) / part, 0, 1) : 0;
    // Where the eye all but stops, no steeper than a cubic that does not turn back.
    const slope = (at: number): number => Math.min(3 / kSteps, part / this.speedAt(at));
    return u + clamp(hermite(x, slope(u), slope(u + 1 / kSteps), 1 / kSteps), 0, 1 / kSteps);
  }

  /** Metres for each u. */
  private speedAt(u: number): number {
    const [, c1, c2, c3] = this.terms;
    return length(add(c1, scale(add(scale(c2, 2), scale(c3, 3 * u)), u)));
  }
}

type Quaternion = readonly [number, number, number, number]; // w, x, y, z

/** Which way a view looks: its axes as the columns of a matrix, right, up and back. */
function turnOf({ eye, target, up }: View): Quaternion {
  const back = normalize(sub(eye, target), vec(0, 0, 1));
  let across = cross(up, back);
  if (length(across) <= 1e-9 * length(up) || length(up) === 0) {
    across = cross(Math.abs(back.y) > 0.5 ? vec(0, 0, -1) : vec(0, 1, 0), back);
  }
  const r = normalize(across, vec(1, 0, 0));
  const u = cross(back, r);
  // The largest of w, x, y and z comes first, so that nothing is divided by what is near 0.
  const squares = [r.x + u.y + back.z, r.x - u.y - back.z, u.y - r.x - back.z, back.z - r.x - u.y];
  const largest = squares.indexOf(Math.max(...squares));
  const first = Math.sqrt((squares[largest] ?? 0) + 1) / 2;
  const s = 0.25 / first;
  const [wx, wy, wz] = [(u.z - back.y) * s, (back.x - r.z) * s, (r.y - u.x) * s];
  const [xy, zx, yz] = [(r.y + u.x) * s, (back.x + r.z) * s, (u.z + back.y) * s];
  if (largest === 0) return [first, wx, wy, wz];
  if (largest === 1) return [wx, first, xy, zx];
  return largest === 2 ? [wy, xy, first, yz] : [wz, zx, yz, first];
}

/** By the shortest way. */
function slerp(a: Quaternion, b: Quaternion, share: number): Quaternion {
  const cosine = a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);
  const sign = cosine < 0 ? -1 : 1;
  const angle = Math.acos(Math.min(1, Math.abs(cosine)));
  const nearly = angle < 1e-7; // as good as linear
  const from = nearly ? 1 - share : Math.sin((1 - share) * angle) / Math.sin(angle);
  const to = sign * (nearly ? share : Math.sin(share * angle) / Math.sin(angle));
  const [w, x, y, z] = a.map((value, i) => from * value + to * (b[i] ?? 0));
  const norm = Math.hypot(w ?? 1, x ?? 0, y ?? 0, z ?? 0);
  return [(w ?? 1) / norm, (x ?? 0) / norm, (y ?? 0) / norm, (z ?? 0) / norm];
}

const upOf = ([w, x, y, z]: Quaternion): Vec => vec(2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x));
const backOf = ([w, x, y, z]: Quaternion): Vec => vec(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));

export class CameraPath {
  private readonly segments: Segment[] = [];
  private readonly ways: number[] = [0]; // metres from the first key to each, and to a loop's end
  private readonly speeds: number[] = []; // metres a second there

  /** Of keys that problemOf() accepts. */
  constructor(readonly keys: PathKeys) {
    const count = keys.keys.length;
    const round = keys.loop && count > 1;
    const segmentCount = round ? count : count - 1;
    for (let i = 0; i < segmentCount; i += 1) {
      const [begin, end] = [this.key(i).eye, this.key(i + 1).eye];
      const [before, after] = [this.key(i + count - 1).eye, this.key(i + 2).eye];
      const hasBefore = (round || i > 0) && apart(before, begin);
      const hasAfter = (round || i + 2 < count) && apart(after, end);
      const segment = new Segment(
        hasBefore ? before : mirrored(begin, end),
        begin,
        end,
        hasAfter ? after : mirrored(end, begin),
      );
      this.segments.push(segment);
      this.ways.push((this.ways[i] ?? 0) + segment.length);
    }
    for (let i = 0; i <= segmentCount && segmentCount > 0; i += 1) this.speeds.push(this.speedOf(i, round));
  }

  get seconds(): number {
    return this.keys.seconds;
  }

  /** Of a key, at a constant speed. */
  evenTimeOf(index: number): number {
    const whole = this.ways.at(-1) ?? 0;
    return whole > 0 ? ((this.ways[index] ?? 0) / whole) * this.keys.seconds : 0;
  }

  /** Before the first key's time, and after the last one's, the camera rests there, but a loop goes round. */
  at(timeS: number): View {
    if (this.segments.length === 0) return this.key(0);
    const { constantSpeed, loop, seconds } = this.keys;
    const firstS = this.timeOf(0);
    let time = clamp(timeS, constantSpeed ? 0 : firstS, constantSpeed ? seconds : this.timeOf(this.segments.length));
    if (loop) {
      const since = (timeS - firstS) % seconds;
      time = firstS + (since < 0 ? since + seconds : since);
    }
    const evenS = loop ? time - firstS : time;
    const way = constantSpeed ? ((this.ways.at(-1) ?? 0) * evenS) / seconds : this.wayAt(time);
    let i = 0;
    while (i + 1 < this.segments.length && (constantSpeed ? way >= (this.ways[i + 1] ?? 0) : time >= this.timeOf(i + 1))) {
      i += 1;
    }
    const whole = this.segment(i).length;
    const along = clamp(way - (this.ways[i] ?? 0), 0, whole);
    const share = whole > 0 ? along / whole : (time - this.timeOf(i)) / (this.timeOf(i + 1) - this.timeOf(i));
    return this.between(i, this.segment(i).placeOf(along), share);
  }

  private key(index: number): Key {
    const key = this.keys.keys[index % this.keys.keys.length];
    if (!key) throw new Error('a camera path without a key');
    return key;
  }

  private segment(index: number): Segment {
    const segment = this.segments[index];
    if (!segment) throw new Error(`no segment ${index}`);
    return segment;
  }

  /** Of a key, and of a loop's end. */
  private timeOf(index: number): number {
    const key = this.keys.keys[index];
    return key ? key.atS : this.keys.seconds + this.key(0).atS;
  }

  /**
   * Steffen's slope: of the parabola through three neighbours, but never so steep that a cubic turns back; at the ends of
   * a path that does not go round, of the segment beside it.
   */
  private speedOf(index: number, round: boolean): number {
    const last = this.segments.length - 1;
    const slope = (i: number): number => this.segment(i).length / (this.timeOf(i + 1) - this.timeOf(i));
    const atEnd = index === 0 || index > last;
    if (atEnd && !round) return slope(index === 0 ? 0 : last);
    const [before, after] = atEnd ? [last, 0] : [index - 1, index];
    const [s0, s1] = [slope(before), slope(after)];
    const [t0, t1] = [before, after].map((i) => this.timeOf(i + 1) - this.timeOf(i)) as [number, number];
    return Math.min((s0 * t1 + s1 * t0) / (t0 + t1), 2 * s0, 2 * s1);
  }

  /** Metres since the first key. */
  private wayAt(timeS: number): number {
    let i = 0;
    while (i + 1 < this.segments.length && timeS >= this.timeOf(i + 1)) i += 1;
    const dt = this.timeOf(i + 1) - this.timeOf(i);
    const x = clamp((timeS - this.timeOf(i)) / dt, 0, 1);
    const way = this.segment(i).length;
    const since = hermite(x, (this.speeds[i] ?? 0) * dt, (this.speeds[i + 1] ?? 0) * dt, way);
    return (this.ways[i] ?? 0) + clamp(since, 0, way);
  }

  private between(index: number, u: number, share: number): View {
    const [a, b] = [this.key(index), this.key(index + 1)];
    const eye = this.segment(index).at(u);
    const turn = slerp(turnOf(a), turnOf(b), share);
    const focus = mix(distance(a.eye, a.target), distance(b.eye, b.target), share);
    return {
      eye,
      target: sub(eye, scale(backOf(turn), focus)),
      up: upOf(turn),
      fovDeg: mix(a.fovDeg, b.fovDeg, share),
    };
  }
}

/** What keeps keys from being a path, as the server words it; empty: nothing. */
export function problemOf({ keys, seconds, constantSpeed, loop }: PathKeys): string {
  if (keys.length === 0 || keys.length > kMaxKeys) return `keys has ${keys.length}; it must have 1 to ${kMaxKeys}`;
  const [first, last] = [keys[0], keys.at(-1)];
  if (!first || !last) return '';
  if (!(first.atS >= 0)) return `keys[0].at_s is ${first.atS}; it must be at least 0`;
  for (const [i, key] of keys.entries()) {
    const before = keys[i - 1];
    if (!before) continue;
    if (!(key.atS - before.atS >= kLeastStepS)) {
      return `keys[${i}].at_s is ${key.atS}; it must be more than ${before.atS}, that of the key before it, by a microsecond or more`;
    }
    if (constantSpeed && equal(key.eye, before.eye)) {
      return `keys[${i}].eye is that of the key before it; with constant_speed each key must be somewhere else`;
    }
  }
  const fits = loop && keys.length > 1 ? seconds - last.atS >= kLeastStepS : seconds >= last.atS;
  if (!fits || !(seconds >= 0)) {
    return `seconds is ${seconds}; it must be ${loop ? 'more than' : 'at least'} ${last.atS}, the time of the last key`;
  }
  if (constantSpeed && loop && equal(first.eye, last.eye)) {
    return 'the last key is where the first one is; a loop goes there by itself';
  }
  return '';
}
