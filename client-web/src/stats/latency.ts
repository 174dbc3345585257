// Sliding statistics of the last samples.

import { SampleWindow } from '../core/sample_window';

/** Sums over the last `spanMs`, as a rate in units a second. */
export class RateMeter {
  private readonly events: { atMs: number; amount: number }[] = [];

  constructor(private readonly spanMs: number) {}

  add(atMs: number, amount: number): void {
    this.events.push({ atMs, amount });
    this.forget(atMs);
  }

  perSecond(nowMs: number): number {
    this.forget(nowMs);
    const total = this.events.reduce((sum, event) => sum + event.amount, 0);
    return (total * 1000) / this.spanMs;
  }

  private forget(nowMs: number): void {
    while (this.events[0] !== undefined && this.events[0].atMs <= nowMs - this.spanMs) {
      this.events.shift();
    }
  }
}

/**
 * Input-to-picture latency on the client's own clock: the server echoes the time stamp of the
 * newest command a frame shows. Only the first frame that shows a command counts; later frames of
 * an animation would show an ever older one.
 */
export class InputLatency {
  readonly window = new SampleWindow(128);
  private shownSeq = 0n;
  private askedSeq = 0n;
  private changedSeq = 0n; // newest command that is known to have changed the view
  private waitingSinceMs: number | null = null; // for a frame that shows a command

  /** A command was sent that a frame is to show. */
  asked(seq: bigint, nowMs: number): void {
    if (seq <= this.shownSeq) return;
    this.askedSeq = seq;
    this.waitingSinceMs ??= nowMs;
  }

  /** The server answered commands up to this one. No frame is to come for what changed nothing. */
  answered(seq: bigint, changed: boolean): void {
    if (changed) this.changedSeq = seq;
    else if (seq >= this.askedSeq && this.shownSeq >= this.changedSeq) this.waitingSinceMs = null;
  }

  /** The server refused it: no frame will show it. */
  refused(): void {
    this.waitingSinceMs = null;
  }

  /** Returns the new sample in ms, or null where the frame shows no new command. */
  painted(appliedSeq: bigint, appliedClientTimeUs: bigint, nowMs: number): number | null {
    if (appliedSeq <= this.shownSeq) return null;
    this.shownSeq = appliedSeq;
    this.waitingSinceMs = appliedSeq < this.askedSeq ? nowMs : null;
    const sample = nowMs - Number(appliedClientTimeUs) / 1000;
    this.window.push(sample);
    return sample;
  }

  /** For how long no frame has shown any command, though one is to come; 0: none is. */
  lagMs(nowMs: number): number {
    return this.waitingSinceMs === null ? 0 : nowMs - this.waitingSinceMs;
  }

  /** A new connection counts its commands from 1 again. */
  restart(): void {
    this.shownSeq = this.askedSeq = this.changedSeq = 0n;
    this.waitingSinceMs = null;
  }
}
