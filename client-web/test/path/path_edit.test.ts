import { describe, expect, it } from 'vitest';

import { vec } from '../../src/core/vec3';
import { CameraPath, problemOf, type PathKeys, type View } from '../../src/path/camera_path';
import { kNoPath, timeOfKey, withKey, withLoop, withoutKey, withSeconds, withTime, withView } from '../../src/path/path_edit';

const viewAt = (x: number): View => ({ eye: vec(x, 1, 0), target: vec(x, 1, -5), up: vec(0, 1, 0), fovDeg: 45 });
const times = ({ keys }: PathKeys): number[] => keys.map(({ atS }) => atS);
const places = ({ keys }: PathKeys): number[] => keys.map(({ eye }) => eye.x);

/** At 0, 2 and 4 s. */
function three(): PathKeys {
  let path = kNoPath;
  for (const x of [0, 1, 2]) ({ path } = withKey(path, viewAt(x), path.seconds));
  return path;
}

describe('path edits', () => {
  it('KeysThatAreAdded_FollowTwoSecondsApart', () => {
    const path = three();
    expect(times(path)).toEqual([0, 2, 4]);
    expect(path.seconds).toBe(4);
    expect(problemOf(path)).toBe('');
  });

  it('KeyAddedBetweenTwo_TakesThatTime', () => {
    const { path, index } = withKey(three(), viewAt(9), 2.5);
    expect(index).toBe(2);
    expect(times(path)).toEqual([0, 2, 2.5, 4]);
    expect(places(path)).toEqual([0, 1, 9, 2]);
    expect(path.seconds).toBe(4);
  });

  it('KeyAddedAtAnother_ComesHalfwayToTheNext', () => {
    const { path, index } = withKey(three(), viewAt(9), 2);
    expect(index).toBe(2);
    expect(times(path)).toEqual([0, 2, 3, 4]);
  });

  it('KeyAddedToALoop_KeepsTheWayBack', () => {
    const loop = withLoop(three(), true);
    expect(loop.seconds).toBe(6);
    const { path } = withKey(loop, viewAt(9), 5);
    expect(times(path)).toEqual([0, 2, 4, 6]);
    expect(path.seconds).toBe(8);
    expect(problemOf(path)).toBe('');
    expect(withLoop(path, false).seconds).toBe(6);
    const one = withKey({ ...kNoPath, loop: true }, viewAt(0), 0).path;
    expect(problemOf(withKey(one, viewAt(1), 0).path)).toBe('');
  });

  it('KeyAddedAtAConstantSpeed_GoesWhereTheEyeIs', () => {
    const even = { ...withView(three(), 2, viewAt(11)), constantSpeed: true }; // 1 m, then 10 m
    expect(timeOfKey(new CameraPath(even), 1)).toBeLessThan(0.5);
    const { path, index } = withKey(even, viewAt(5), 1);
    expect(index).toBe(2);
    expect(problemOf(path)).toBe('');
  });

  it('Key_IsMovedInPlaceAndInTime', () => {
    expect(places(withView(three(), 1, viewAt(7)))).toEqual([0, 7, 2]);
    expect(times(withTime(three(), 1, 3.333))).toEqual([0, 3.33, 4]);
    expect(times(withTime(three(), 1, 99))).toEqual([0, 3.99, 4]);
    expect(times(withTime(three(), 1, -5))).toEqual([0, 0.01, 4]);
    const longer = withTime(three(), 2, 10);
    expect(longer.seconds).toBe(10);
    const loop = withTime(withLoop(three(), true), 2, 99);
    expect(times(loop)).toEqual([0, 2, 5.99]);
    expect(problemOf(loop)).toBe('');
  });

  it('Key_IsRemoved_AndTheLastOneTakesTheEndWithIt', () => {
    const shorter = withoutKey(three(), 2);
    expect(times(shorter)).toEqual([0, 2]);
    expect(shorter.seconds).toBe(2);
    expect(withoutKey(three(), 0).seconds).toBe(4);
    expect(withoutKey(withLoop(three(), true), 2).seconds).toBe(6);
  });

  it('Length_ScalesAllTimes', () => {
    const path = withSeconds(three(), 8);
    expect(times(path)).toEqual([0, 4, 8]);
    expect(problemOf(path)).toBe('');
  });
});
