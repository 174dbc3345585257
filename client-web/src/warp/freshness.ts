// Whether the server's pictures come so soon that a warp would gain nothing: it resamples the picture,
// and depth takes bytes.

/** Of the display: a shorter time from input to picture than so many frames is soon. */
const kFreshFrames = 2;
/** And a longer one is late again. */
const kStaleFrames = 3;
const kUsualFrameMs = 1000 / 60;
/** What two callbacks of one frame, and what a page that is busy, are apart. */
const kShortestFrameMs = 3;

export class Freshness {
  private isFresh = false;
  private frameMs = kUsualFrameMs;
  private lastMs = -Infinity;

  get fresh(): boolean {
    return this.isFresh;
  }

  /** Of an animation frame, one after another while the camera moves. */
  noteFrame(nowMs: number): void {
    const pauseMs = nowMs - this.lastMs;
    this.lastMs = nowMs;
    if (pauseMs >= kShortestFrameMs) this.frameMs = Math.min(this.frameMs, pauseMs);
  }

  /** `p95Ms`: from input to picture; null: no camera moved of late. Whether that changes anything. */
  noteLatency(p95Ms: number | null): boolean {
    if (p95Ms === null) return false;
    const before = this.isFresh;
    this.isFresh = p95Ms < (before ? kStaleFrames : kFreshFrames) * this.frameMs;
    return this.isFresh !== before;
  }
}
