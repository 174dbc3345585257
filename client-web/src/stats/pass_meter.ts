// Time of each GPU pass, as a mean over the last frames. No DOM.

import type { FrameHeader } from '../gen/froxel/v1/server_pb';

const kFrames = 30;

export interface PassShare {
  readonly name: string;
  readonly ms: number;
  readonly share: number; // of all passes, 0..1
}

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
      ms:
        frames.reduce((sum, frame) => sum + (frame.passes[index]?.gpuUs ?? 0), 0) /
        frames.length /
        1000,
    }));
    const whole = passes.reduce((sum, pass) => sum + pass.ms, 0);
    return passes.map((pass) => ({ ...pass, share: whole > 0 ? pass.ms / whole : 0 }));
  }
}

const namesOf = ({ passes }: FrameHeader): string => passes.map(({ name }) => name).join(' ');
