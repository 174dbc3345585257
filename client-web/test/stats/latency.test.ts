import { describe, expect, it } from 'vitest';

import { InputLatency, RateMeter } from '../../src/stats/latency';

describe('RateMeter', () => {
  it('Rate_CountsOnlyTheSpan', () => {
    const meter = new RateMeter(2000);
    meter.add(0, 100);
    meter.add(1500, 10);
    expect(meter.perSecond(1600)).toBe(55);
    expect(meter.perSecond(2100)).toBe(5);
    expect(meter.perSecond(9000)).toBe(0);
  });
});

describe('InputLatency', () => {
  it('Sample_IsTakenOnlyFromTheFirstFrameThatShowsACommand', () => {
    const latency = new InputLatency();
    expect(latency.painted(1n, 100_000n, 150)).toBe(50);
    expect(latency.painted(1n, 100_000n, 190)).toBeNull();
    expect(latency.painted(3n, 180_000n, 200)).toBe(20);
    expect(latency.window.percentile(1)).toBe(50);
  });

  it('Frame_ThatShowsNoCommand_GivesNoSample', () => {
    expect(new InputLatency().painted(0n, 0n, 99)).toBeNull();
  });

  it('CommandThatChangesNothing_IsNotWaitedFor', () => {
    const latency = new InputLatency();
    latency.asked(1n, 1_000);
    latency.answered(1n, true);
    latency.asked(2n, 1_100);
    latency.answered(2n, false);
    expect(latency.lagMs(1_200)).toBe(200); // for the picture of the first
    latency.painted(1n, 0n, 1_300);
    latency.asked(3n, 1_400);
    latency.answered(3n, false);
    expect(latency.lagMs(9_000)).toBe(0);
  });

  it('Lag_GrowsUntilAFrameShowsWhatWasAsked', () => {
    const latency = new InputLatency();
    expect(latency.lagMs(1_000)).toBe(0);
    latency.asked(2n, 1_000);
    latency.asked(3n, 1_500);
    expect(latency.lagMs(2_000)).toBe(1_000);
    latency.painted(2n, 0n, 2_100); // of two things the first: it goes on
    expect(latency.lagMs(2_200)).toBe(100);
    latency.painted(2n, 0n, 2_300);
    expect(latency.lagMs(2_400)).toBe(300);
    latency.painted(3n, 0n, 2_500);
    expect(latency.lagMs(9_000)).toBe(0);
    latency.asked(3n, 9_000); // shown already
    expect(latency.lagMs(9_500)).toBe(0);
  });

  it('Lag_OfWhatTheServerRefusedOrAConnectionLost_IsNone', () => {
    const latency = new InputLatency();
    latency.asked(2n, 1_000);
    latency.refused();
    expect(latency.lagMs(2_000)).toBe(0);
    latency.asked(3n, 2_000);
    latency.restart();
    expect(latency.lagMs(3_000)).toBe(0);
  });

  it('Restart_LetsSequencesBeginAgain', () => {
    const latency = new InputLatency();
    latency.painted(40n, 0n, 1);
    latency.restart();
    expect(latency.painted(1n, 1_000n, 3)).toBe(2);
  });
});
