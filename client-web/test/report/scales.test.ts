import { describe, expect, it } from 'vitest';

import { apart, clear, logAxis, logTicks, shortNumber, spansDecades } from '../../report/scales';

describe('shortNumber', () => {
  it.each([
    [0, '0'],
    [0.002, '0.002'],
    [3e-5, '3e-5'],
    [2.5e-7, '2.5e-7'],
    [15, '15'],
    [999, '999'],
    [1000, '1k'],
    [2500, '2.5k'],
    [921_600, '922k'],
    [999_900, '1M'],
    [1e6, '1M'],
    [2e9, '2G'],
  ])('%d_Is_%s', (value, text) => {
    expect(shortNumber(value)).toBe(text);
  });
});

describe('logTicks', () => {
  it('ManyDecades_ArePowersOfTen', () => {
    expect(logTicks(1, 1000)).toEqual([1, 10, 100, 1000]);
  });

  it('FewDecades_HaveStepsBetween', () => {
    expect(logTicks(20, 500)).toEqual([20, 50, 100, 200, 500]);
  });
});

describe('logAxis', () => {
  it('PositiveValues_HaveNoFloor', () => {
    const axis = logAxis([3, 40, 400]);
    expect(axis.floor).toBeNull();
    expect(axis.domain).toEqual([2, 500]);
    expect(axis.place(40)).toBe(40);
  });

  it('Zero_StandsBelowTheRestAndReads0', () => {
    const axis = logAxis([0, 1e-4, 0.1]);
    expect(axis.floor).toBeLessThan(1e-4);
    expect(axis.place(0)).toBe(axis.floor);
    expect(axis.domain[0]).toBe(axis.floor);
    expect(axis.ticks[0]).toBe(axis.floor);
    expect(axis.label(axis.place(0))).toBe('0');
    expect(axis.label(1e-4)).toBe('1e-4');
  });

  it('OnlyZeros_HaveAnAxis', () => {
    const axis = logAxis([0, 0]);
    expect(axis.domain[0]).toBeGreaterThan(0);
    expect(axis.domain[1]).toBeGreaterThan(axis.domain[0]);
    expect(axis.place(0)).toBe(axis.floor);
  });

  it('OneValue_HasRoomAround', () => {
    const { domain } = logAxis([10]);
    expect(domain[0]).toBeLessThanOrEqual(10);
    expect(domain[1]).toBeGreaterThan(10);
  });

  it('EveryValue_IsInTheDomain', () => {
    for (let power = -9; power < 9; power += 0.37) {
      const [low, high] = [10 ** power, 10 ** (power + 1.3)];
      const { domain, share } = logAxis([low, high]);
      expect(domain[0]).toBeLessThanOrEqual(low * (1 + 1e-9));
      expect(domain[1]).toBeGreaterThanOrEqual(high * (1 - 1e-9));
      expect(share(low)).toBeGreaterThanOrEqual(-1e-9);
      expect(share(high)).toBeLessThanOrEqual(1 + 1e-9);
    }
  });

  it('Share_IsLinearInTheLogarithm', () => {
    const { share } = logAxis([1, 10, 100]);
    expect(share(1)).toBe(0);
    expect(share(10)).toBeCloseTo(0.5, 12);
    expect(share(100)).toBeCloseTo(1, 12);
  });
});

describe('apart', () => {
  it('CrowdedPositions_KeepFirstAndLast', () => {
    expect(apart([0, 10, 50, 95, 100], 45)).toEqual([0, 2, 4]);
  });

  it('Neighbours_AreAGapApart', () => {
    const positions = Array.from({ length: 60 }, (_, i) => i * 7 + (i % 3));
    const kept = apart(positions, 40).map((index) => positions[index] ?? 0);
    for (let i = 1; i < kept.length; i += 1) {
      expect((kept[i] ?? 0) - (kept[i - 1] ?? 0)).toBeGreaterThanOrEqual(40);
    }
  });

  it('OneOrNoPosition_IsKept', () => {
    expect(apart([], 10)).toEqual([]);
    expect(apart([5], 10)).toEqual([0]);
  });
});

describe('clear', () => {
  it('PointsCloseInBothDirections_LoseTheSecond', () => {
    const points = [
      { x: 0, y: 0 },
      { x: 5, y: 5 },
      { x: 5, y: 50 },
      { x: 50, y: 5 },
    ];
    expect(clear(points, 15)).toEqual([true, false, true, true]);
  });
});

describe('spansDecades', () => {
  it('RangeAndZero_Decide', () => {
    expect(spansDecades([1, 9])).toBe(true);
    expect(spansDecades([1, 8])).toBe(false);
    expect(spansDecades([0, 1000])).toBe(false);
    expect(spansDecades([])).toBe(false);
  });
});
