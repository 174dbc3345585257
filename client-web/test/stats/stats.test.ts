import { describe, expect, it } from 'vitest';

import { Stats } from '../../src/stats/stats';
import { frameHeader } from '../fakes';

const header = frameHeader({
  frameId: 1n,
  appliedSeq: 1n,
  appliedClientTimeUs: 1_000_000n,
  queueUs: 2_000,
  renderUs: 10_000,
  encodeWaitUs: 1_000,
  encodeUs: 4_000,
  sendWaitUs: 500,
});

describe('Stats', () => {
  it('Stages_AddUpToTheWholeWay', () => {
    const stats = new Stats();
    stats.painted(header, 3, 1030);
    const { stagesMs, latencyP50Ms } = stats.figures(1030);
    expect(latencyP50Ms).toBe(30);
    expect(stagesMs.network).toBeCloseTo(9.5, 9);
    const sum = Object.values(stagesMs).reduce((total: number, part) => total + (part ?? 0), 0);
    expect(sum).toBeCloseTo(30, 9);
  });

  it('Rates_CountFramesAndBytes', () => {
    const stats = new Stats();
    for (let i = 0; i < 20; i += 1) {
      stats.received(1000, i * 100);
      stats.painted(header, 1, i * 100);
    }
    expect(stats.figures(1900).framesPerSecond).toBe(10);
    expect(stats.figures(1900).bytesPerSecond).toBe(10_000);
  });

  it('History_HasIntervalsAndLatenciesOfTheSameFramesAndAnEnd', () => {
    const stats = new Stats();
    for (let i = 0; i < 500; i += 1) stats.painted(header, 1, 2000 + i * 20);
    const { timeS, intervalMs, latencyMs } = stats.history;
    expect(timeS.length).toBe(150);
    expect(intervalMs.length).toBe(150);
    expect(latencyMs.length).toBe(150);
    expect(intervalMs.at(-1)).toBe(20);
  });

  it('PauseOfAStillPicture_IsNoFrameInterval', () => {
    const stats = new Stats();
    for (const nowMs of [2000, 2050, 9000]) stats.painted(header, 1, nowMs);
    expect(stats.history.intervalMs).toEqual([null, 50, null]);
  });

  it('IsStill_WhenNothingIsAskedForAndNoPictureComes', () => {
    const stats = new Stats();
    expect(stats.figures(1_000).isStill).toBe(false); // before the first picture
    stats.painted(header, 1, 1_000);
    expect(stats.figures(1_500).isStill).toBe(false);
    expect(stats.figures(4_000).isStill).toBe(true);
    stats.asked(2n, 4_000);
    expect(stats.figures(8_000).isStill).toBe(false); // a slow one
  });
});
