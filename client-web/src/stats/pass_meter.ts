// Time of each GPU pass, as a mean over the last frames. No DOM.

import type { FrameHeader } from '../gen/froxel/v1/server_pb';

const kFrames = 30;

/** A driver may write no timestamps: the pass's time is null then, and the share of every pass. */
export interface PassShare {
  readonly name: string;
  readonly ms: number | null;
  readonly share: number | null; // of all passes, 0..1
}

/** The sum; null where a part is. */
export const sumOf = (parts: readonly (number | null)[]): number | null =>
  parts.reduce((sum, part) => (sum === null || part === null ? null : sum + part), 0);

export class PassMeter {
  private frames: FrameHeader[] = [];

  /** A frame of other passes than the last one's starts anew: a mean over both would be of neither. */
  add(header: FrameHeader): void {
    const before = this.frames.at(-1);
    if (before && namesOf(before) !== namesOf(header)) this.frames = [];
    this.frames.push(header);
    if (this.frames.length > kFrames) this.frames.shift();
  }

  /** In the order in which they ran. */
  shares(): PassShare[] {
    const { frames } = this;
    const passes = (frames.at(-1)?.passes ?? []).map(({ name }, index) => ({
      name,
      ms: meanMs(frames.map((frame) => frame.passes[index]?.gpuUs)),
    }));
    const whole = sumOf(passes.map(({ ms }) => ms));
    return passes.map(({ name, ms }) => ({
      name,
      ms,
      share: whole === null || ms === null ? null : whole > 0 ? ms / whole : 0,
    }));
  }
}

function meanMs(times: readonly (number | undefined)[]): number | null {
  const sum = sumOf(times.map((us) => us ?? null));
  return sum === null ? null : sum / times.length / 1000;
}

const namesOf = ({ passes }: FrameHeader): string => passes.map(({ name }) => name).join(' ');
