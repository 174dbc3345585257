import { describe, expect, it } from 'vitest';

import { vec } from '../../src/core/vec3';
import { CameraPath, type View } from '../../src/path/camera_path';
import { kNoPath, withKey } from '../../src/path/path_edit';
import { PathPlayer } from '../../src/path/path_player';

const viewAt = (x: number): View => ({ eye: vec(x, 1, 0), target: vec(x, 1, -5), up: vec(0, 1, 0), fovDeg: 45 });

/** From x = 0 to 4 within two seconds. */
function pathOf(loop = false): CameraPath {
  let { path } = withKey(kNoPath, viewAt(0), 0);
  ({ path } = withKey(path, viewAt(4), 0));
  return new CameraPath({ ...path, loop, seconds: loop ? 4 : 2 });
}

class Stage {
  now: View | null = viewAt(9);
  readonly told: [number, boolean][] = [];
  private due: ((nowMs: number) => void)[] = [];
  private ms = 1000;
  readonly player = new PathPlayer({
    view: () => this.now,
    setView: (view) => (this.now = view),
    nextFrame: (action) => void this.due.push(action),
    moved: (timeS, playing) => void this.told.push([timeS, playing]),
  });

  after(ms: number): void {
    this.ms += ms;
    for (const action of this.due.splice(0)) action(this.ms);
  }

  get x(): number {
    return this.now?.eye.x ?? NaN;
  }

  get waits(): number {
    return this.due.length;
  }
}

describe('PathPlayer', () => {
  it('Play_FollowsTheTime_AndStopsAtTheEnd', () => {
    const stage = new Stage();
    stage.player.play(pathOf(), 0);
    expect(stage.x).toBe(0);
    stage.after(0);
    for (let i = 0; i < 5; i += 1) stage.after(200);
    expect(stage.x).toBeCloseTo(2, 6);
    for (let i = 0; i < 6; i += 1) stage.after(200);
    expect(stage.x).toBeCloseTo(4, 9);
    expect(stage.player.playing).toBe(false);
    expect(stage.told.at(-1)).toEqual([2, false]);
    expect(stage.waits).toBe(0);
    stage.player.play(pathOf(), 2); // from its beginning again
    expect(stage.x).toBe(0);
  });

  it('Loop_GoesRound', () => {
    const stage = new Stage();
    stage.player.play(pathOf(true), 3.9);
    stage.after(0);
    stage.after(200);
    expect(stage.told.at(-1)?.[0]).toBeCloseTo(0.1, 9);
    expect(stage.player.playing).toBe(true);
  });

  it('WhoSteers_StopsIt', () => {
    const stage = new Stage();
    stage.player.play(pathOf(), 0);
    stage.after(0);
    stage.now = viewAt(7);
    stage.after(16);
    expect(stage.player.playing).toBe(false);
    expect(stage.x).toBe(7);
  });

  it('LostControl_StopsIt', () => {
    const stage = new Stage();
    stage.player.play(pathOf(), 0);
    stage.now = null;
    stage.after(16);
    expect(stage.player.playing).toBe(false);
  });

  it('PageThatSlept_GoesOnWhereItWas', () => {
    const stage = new Stage();
    stage.player.play(pathOf(), 0);
    stage.after(0);
    stage.after(60_000);
    expect(stage.told.at(-1)?.[0]).toBeCloseTo(0.25, 9);
  });

  it('PlayedAgain_AsksForOneFrameAtATime', () => {
    const stage = new Stage();
    stage.player.play(pathOf(), 0);
    stage.player.play(pathOf(), 1);
    expect(stage.waits).toBe(1);
    stage.player.stop();
    stage.player.play(pathOf(), 1);
    expect(stage.waits).toBe(1);
    stage.player.stop();
    stage.after(16);
    expect(stage.waits).toBe(0);
  });
});
