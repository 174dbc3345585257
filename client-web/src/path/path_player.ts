// Moves the camera along a path as time goes by, until it ends or somebody else steers.

import { equal } from '../core/vec3';
import type { CameraPath, View } from './camera_path';

export interface PlayerActions {
  /** Where the camera is; null: there is none, or somebody else steers. */
  view(): View | null;
  setView(view: View): void;
  nextFrame(action: (nowMs: number) => void): void;
  /** After each step, and when it stops. */
  moved(timeS: number, playing: boolean): void;
}

/** A page that was asleep goes on where it was. */
const kLongestStepS = 0.25;

export class PathPlayer {
  private path: CameraPath | null = null; // while it plays
  private timeS = 0;
  private lastMs = 0;
  private shown: View | null = null;
  private asked = false; // for a frame

  constructor(private readonly actions: PlayerActions) {}

  get playing(): boolean {
    return this.path !== null;
  }

  /** From its beginning where `fromS` is its end. */
  play(path: CameraPath, fromS: number): void {
    this.path = path;
    this.timeS = fromS < path.seconds ? fromS : 0;
    this.lastMs = 0;
    this.show(path);
    this.askForFrame();
  }

  stop(): void {
    if (!this.path) return;
    this.path = null;
    this.shown = null;
    this.actions.moved(this.timeS, false);
  }

  private askForFrame(): void {
    if (this.asked) return;
    this.asked = true;
    this.actions.nextFrame((nowMs) => this.step(nowMs));
  }

  private step(nowMs: number): void {
    this.asked = false;
    const { path, shown } = this;
    if (!path) return;
    const now = this.actions.view();
    if (!now || !shown || !equal(now.eye, shown.eye) || !equal(now.target, shown.target)) {
      this.stop();
      return;
    }
    const step = this.lastMs === 0 ? 0 : Math.min((nowMs - this.lastMs) / 1000, kLongestStepS);
    this.lastMs = nowMs;
    const { seconds, keys } = path;
    this.timeS += step;
    const ends = !keys.loop && this.timeS >= seconds;
    if (keys.loop && seconds > 0) this.timeS %= seconds;
    if (ends) this.timeS = seconds;
    this.show(path);
    if (ends) this.stop();
    else this.askForFrame();
  }

  private show(path: CameraPath): void {
    const { eye, target, up, fovDeg } = path.at(this.timeS);
    this.shown = { eye, target, up, fovDeg };
    this.actions.setView(this.shown);
    this.actions.moved(this.timeS, true);
  }
}
