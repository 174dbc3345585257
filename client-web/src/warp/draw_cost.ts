// Whether drawing takes so long that the server's pictures are better shown as they come. Whoever
// waits for a device stops it, so that only some draws are timed.

import { SampleWindow } from '../core/sample_window';

const kTimedEach = 30; // draws
const kTimed = 5; // of which the median counts
/** Twenty a second are smoother than the pictures of a slow server. */
const kSlowMs = 50;

export class DrawCost {
  private draws = 0;
  private readonly timesMs = new SampleWindow(kTimed);

  /** `finish` waits until all is drawn. */
  draw(draw: () => void, finish: () => void, nowMs: () => number): void {
    this.draws += 1;
    if (this.draws % kTimedEach > 0) {
      draw();
      return;
    }
    finish(); // what came before
    const beginMs = nowMs();
    draw();
    finish();
    this.timesMs.push(nowMs() - beginMs);
  }

  /** Milliseconds of a draw, if that is too many; else null. */
  get slowMs(): number | null {
    const medianMs = this.timesMs.count < kTimed ? null : this.timesMs.percentile(0.5);
    return medianMs !== null && medianMs > kSlowMs ? medianMs : null;
  }
}
