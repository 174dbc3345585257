// Camera moves as pure functions: pose in, pose out. Turntable convention: the world's +Y stays up,
// so a rolled scene camera straightens when it is first moved.

import { add, cross, dot, length, normalize, scale, sub, vec, type Vec } from '../core/vec3';

export interface Pose {
  readonly eye: Vec; // metres, world
  readonly target: Vec;
  readonly up: Vec;
}

const kUp = vec(0, 1, 0);
/** Keeps the view off the poles, where "up" has no meaning. */
const kPitchLimitRad = (89 * Math.PI) / 180;
interface Spherical {
  readonly yaw: number; // radians about +Y, 0 looks along -Z
  readonly pitch: number; // radians, positive looks up
  readonly distance: number; // metres, eye to target
}

function sphericalOf(pose: Pose): Spherical {
  const d = sub(pose.target, pose.eye);
  const distance = Math.max(length(d), 1e-6);
  const pitch = Math.asin(Math.max(-1, Math.min(1, d.y / distance)));
  const yaw =
    Math.hypot(d.x, d.z) > 1e-9 * distance
      ? Math.atan2(-d.x, -d.z)
      : Math.atan2(-pose.up.x * -Math.sign(d.y), -pose.up.z * -Math.sign(d.y));
  return { yaw, pitch: clampPitch(pitch), distance };
}

function clampPitch(pitch: number): number {
  return Math.max(-kPitchLimitRad, Math.min(kPitchLimitRad, pitch));
}

function forwardOf(yaw: number, pitch: number): Vec {
  return vec(
    -Math.sin(yaw) * Math.cos(pitch),
    Math.sin(pitch),
    -Math.cos(yaw) * Math.cos(pitch),
  );
}

interface Frame {
  readonly forward: Vec;
  readonly right: Vec;
  readonly up: Vec;
}

function frameOf(pose: Pose): Frame {
  const { yaw, pitch } = sphericalOf(pose);
  const forward = forwardOf(yaw, pitch);
  const right = normalize(cross(forward, kUp), vec(1, 0, 0));
  return { forward, right, up: cross(right, forward) };
}

/** Turns the eye about the target; angles in radians, positive: the scene follows the pointer. */
export function orbit(pose: Pose, right: number, down: number): Pose {
  const s = sphericalOf(pose);
  const forward = forwardOf(s.yaw - right, clampPitch(s.pitch - down));
  return { eye: sub(pose.target, scale(forward, s.distance)), target: pose.target, up: kUp };
}

/** Turns the view about the eye; angles in radians. */
export function look(pose: Pose, right: number, down: number): Pose {
  const s = sphericalOf(pose);
  const forward = forwardOf(s.yaw - right, clampPitch(s.pitch - down));
  return { eye: pose.eye, target: add(pose.eye, scale(forward, s.distance)), up: kUp };
}

/**
 * Slides eye and target so that what lies at the target's depth follows the pointer; `right` and
 * `down` as fractions of the picture's height, which spans `heightM` metres there.
 */
export function pan(pose: Pose, right: number, down: number, heightM: number): Pose {
  const frame = frameOf(pose);
  return shift(pose, add(scale(frame.right, -right * heightM), scale(frame.up, down * heightM)));
}

/** Scales the distance to the target by `factor`; nearer than `closestM` the target is pushed along. */
export function zoom(pose: Pose, factor: number, closestM: number): Pose {
  const s = sphericalOf(pose);
  const forward = forwardOf(s.yaw, s.pitch);
  const distance = Math.max(s.distance * factor, closestM);
  const eye = add(pose.eye, scale(forward, s.distance * (1 - factor)));
  return { eye, target: add(eye, scale(forward, distance)), up: kUp };
}

/** Moves along the view's own axes, in metres. */
export function fly(pose: Pose, right: number, up: number, forward: number): Pose {
  const frame = frameOf(pose);
  const across = add(scale(frame.right, right), scale(kUp, up));
  return shift(pose, add(across, scale(frame.forward, forward)));
}

/** Where a camera may go: a ball, metres. */
export interface Reach {
  readonly centre: Vec;
  readonly radiusM: number;
}

/** Of a move, what is not worth a command. */
const kLeastShare = 1e-6;

/** The move from one pose to the next, as far as eye and target stay within reach. Who is outside may come nearer. */
export function withinReach(from: Pose, to: Pose, reach: Reach): Pose {
  const share = Math.min(shareWithin(from.eye, to.eye, reach), shareWithin(from.target, to.target, reach));
  if (share === 1) return to;
  if (share < kLeastShare) return from; // at the edge already
  const part = (a: Vec, b: Vec): Vec => add(a, scale(sub(b, a), share));
  return { eye: part(from.eye, to.eye), target: part(from.target, to.target), up: to.up };
}

/** How much of the way from `a` to `b` lies within the ball: 0 to 1. */
function shareWithin(a: Vec, b: Vec, { centre, radiusM }: Reach): number {
  const [from, way] = [sub(a, centre), sub(b, a)];
  const radius = Math.max(radiusM, length(from));
  if (length(sub(b, centre)) <= radius) return 1;
  const [p, q] = [dot(from, way) / dot(way, way), (dot(from, from) - radius * radius) / dot(way, way)];
  return Math.max(0, Math.min(1, -p + Math.sqrt(Math.max(0, p * p - q))));
}

function shift(pose: Pose, by: Vec): Pose {
  return { eye: add(pose.eye, by), target: add(pose.target, by), up: kUp };
}
