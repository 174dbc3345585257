// What a frame of each look takes on the device, as far as this page has seen it. No DOM.

import type { FrameHeader } from '../gen/froxel/v1/server_pb';
import { sumOf } from './pass_meter';

/** Frames of one state that a cost is the mean of: at least, and at most. */
const kFewFrames = 5;
const kFrames = 30;

export class LookCosts {
  private readonly costsMs = new Map<string, number>();
  private shownSeq = -1n;
  private framesMs: number[] = []; // of the state of that command

  painted({ appliedSeq, passes }: Pick<FrameHeader, 'appliedSeq' | 'passes'>): void {
    if (appliedSeq !== this.shownSeq) this.framesMs = [];
    this.shownSeq = appliedSeq;
    const us = sumOf(passes.map(({ gpuUs }) => gpuUs ?? null));
    if (us !== null) this.framesMs = [...this.framesMs, us / 1000].slice(-kFrames);
  }

  /** The view is at these looks since `newestSeq`, the newest command that sets it. */
  note(names: readonly string[], newestSeq: bigint): void {
    if (this.framesMs.length < kFewFrames || this.shownSeq < newestSeq) return;
    const cost = this.framesMs.reduce((sum, ms) => sum + ms, 0) / this.framesMs.length;
    for (const name of names) this.costsMs.set(name, cost);
  }

  /** Undefined: not known. */
  ofMs(name: string): number | undefined {
    return this.costsMs.get(name);
  }
}
