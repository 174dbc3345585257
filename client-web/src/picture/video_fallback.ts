// What to do when video cannot be decoded. Pure: the caller passes the time.

/** So many failures within kForgetMs, and the browser is not to be trusted with video. */
const kFailures = 3;
const kForgetMs = 30_000;
/** A key frame that was asked for and did not come is asked for again. */
const kPatienceMs = 2_000;

export type Remedy = 'key frame' | 'plain codec' | 'wait';

export class VideoFallback {
  private failures: number[] = []; // when
  private askedAtMs = -Infinity;

  /** The decoder failed (`broken`), or a frame came that it cannot use before a key frame. */
  lost(broken: boolean, nowMs: number): Remedy {
    if (broken) {
      this.failures = [...this.failures.filter((at) => nowMs - at < kForgetMs), nowMs];
      if (this.failures.length >= kFailures) {
        this.failures = [];
        return 'plain codec';
      }
    } else if (nowMs - this.askedAtMs < kPatienceMs) {
      return 'wait';
    }
    this.askedAtMs = nowMs;
    return 'key frame';
  }
}
