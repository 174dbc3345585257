import { describe, expect, it } from 'vitest';

import { cross, length, sub, vec, type Vec } from '../../src/core/vec3';
import { fly, look, orbit, pan, withinReach, zoom, type Pose } from '../../src/steering/camera_controller';

const kPose: Pose = { eye: vec(0, 1, 5), target: vec(0, 1, 0), up: vec(0, 1, 0) };
const distance = (pose: Pose): number => length(sub(pose.target, pose.eye));

function expectVec(actual: Vec, x: number, y: number, z: number): void {
  expect(actual.x).toBeCloseTo(x, 9);
  expect(actual.y).toBeCloseTo(y, 9);
  expect(actual.z).toBeCloseTo(z, 9);
}

describe('orbit', () => {
  it('DragRight_MovesTheEyeLeftAboutTheTarget', () => {
    const pose = orbit(kPose, Math.PI / 2, 0);
    expectVec(pose.target, 0, 1, 0);
    expectVec(pose.eye, -5, 1, 0);
  });

  it('DragDown_RaisesTheEye', () => {
    const pose = orbit(kPose, 0, Math.PI / 6);
    expect(pose.eye.y).toBeCloseTo(1 + 5 * Math.sin(Math.PI / 6), 9);
    expect(distance(pose)).toBeCloseTo(5, 9);
  });

  it('Pitch_NeverReachesThePole', () => {
    for (const down of [-10, 10]) {
      const pose = orbit(kPose, 0, down);
      expect(length(cross(sub(pose.target, pose.eye), pose.up))).toBeGreaterThan(0.05);
    }
  });

  it('StraightDownCamera_KeepsItsHeadingOnceMoved', () => {
    const above: Pose = { eye: vec(0, 5, 0), target: vec(0, 0, 0), up: vec(1, 0, 0) };
    const pose = orbit(above, 0, 0);
    // Up in the picture was +X: tilted up a little, the view goes on towards +X.
    expect(sub(pose.target, pose.eye).x).toBeGreaterThan(0);
    expect(Math.abs(sub(pose.target, pose.eye).z)).toBeLessThan(1e-9);
  });

  it('ThereAndBack_IsThePoseAgain', () => {
    const pose = orbit(orbit(kPose, 0.7, 0.3), -0.7, -0.3);
    expectVec(pose.eye, 0, 1, 5);
  });
});

describe('look', () => {
  it('KeepsTheEyeAndTheDistance', () => {
    const pose = look(kPose, Math.PI / 2, 0);
    expectVec(pose.eye, 0, 1, 5);
    expectVec(pose.target, 5, 1, 5);
  });
});

describe('pan', () => {
  it('TheTargetsPointFollowsThePointer', () => {
    const pose = pan(kPose, 0.5, 0.25, 4);
    expectVec(pose.target, -2, 2, 0);
    expectVec(pose.eye, -2, 2, 5);
  });
});

describe('zoom', () => {
  it('ScalesTheDistance', () => {
    expectVec(zoom(kPose, 0.5, 0.05).eye, 0, 1, 2.5);
    expectVec(zoom(kPose, 2, 0.05).eye, 0, 1, 10);
  });

  it('AtTheClosest_PushesTheTargetAlong', () => {
    let pose = kPose;
    for (let i = 0; i < 200; i += 1) pose = zoom(pose, 0.8, 0.05);
    expect(distance(pose)).toBeCloseTo(0.05, 9);
    expect(pose.eye.z).toBeLessThan(0);
  });
});

describe('withinReach', () => {
  const reach = { centre: vec(0, 0, 0), radiusM: 20 };
  const eyeDistance = ({ eye }: Pose): number => length(eye);

  it('120NotchesOut_EndsAtItsEdge_AndOneBackIsNearer', () => {
    let pose = kPose;
    for (let i = 0; i < 120; i += 1) pose = withinReach(pose, zoom(pose, 1.2, 0.05), reach);
    expect(eyeDistance(pose)).toBeCloseTo(20, 6);
    expectVec(pose.target, 0, 1, 0);
    const back = withinReach(pose, zoom(pose, 1 / 1.2, 0.05), reach);
    expect(eyeDistance(back)).toBeLessThan(18);
  });

  it('Pan_EndsForEyeAndTarget', () => {
    let pose = kPose;
    for (let i = 0; i < 500; i += 1) pose = withinReach(pose, pan(pose, -0.5, 0, 4), reach);
    expect(Math.max(length(pose.eye), length(pose.target))).toBeCloseTo(20, 6);
    expect(distance(pose)).toBeCloseTo(5, 9);
  });

  it('WhoIsOutside_MayComeNearer_AndGoesNoFarther', () => {
    const outside: Pose = { eye: vec(0, 0, 100), target: vec(0, 0, 0), up: vec(0, 1, 0) };
    expect(withinReach(outside, zoom(outside, 0.5, 0.05), reach).eye.z).toBeCloseTo(50, 6);
    expect(withinReach(outside, zoom(outside, 2, 0.05), reach).eye.z).toBeCloseTo(100, 6);
  });

  it('NoMove_StaysAsItIs', () => {
    const outside: Pose = { eye: vec(0, 0, 100), target: vec(0, 0, 0), up: vec(0, 1, 0) };
    expect(withinReach(outside, outside, reach)).toEqual(outside);
  });
});

describe('fly', () => {
  it('MovesAlongTheViewsAxes', () => {
    const pose = fly(kPose, 1, 2, 3);
    expectVec(pose.eye, 1, 3, 2);
    expectVec(pose.target, 1, 3, -3);
  });
});
