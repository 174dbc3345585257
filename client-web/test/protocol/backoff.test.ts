import { describe, expect, it } from 'vitest';

import { backoffMs, kFirstDelayMs, kLongestDelayMs } from '../../src/protocol/backoff';

describe('backoffMs', () => {
  it('Delay_WithoutLuck_StartsAtTheFloor', () => {
    expect(backoffMs(0, () => 0)).toBe(kFirstDelayMs);
    expect(backoffMs(9, () => 0)).toBe(kFirstDelayMs);
  });

  it('Ceiling_DoublesWithEachAttemptUpToTheLongest', () => {
    const almostOne = (): number => 0.999999;
    const ceilings = [0, 1, 2, 3, 4, 5, 50].map((attempt) => backoffMs(attempt, almostOne));
    expect(ceilings).toEqual([1000, 2000, 4000, 8000, kLongestDelayMs, kLongestDelayMs, kLongestDelayMs]);
  });
});
