import { describe, expect, it } from 'vitest';

import { SampleWindow } from '../../src/core/sample_window';

describe('SampleWindow', () => {
  it('Percentile_OfNothing_IsNull', () => {
    expect(new SampleWindow(4).percentile(0.5)).toBeNull();
  });

  it('Percentile_IsTheNearestRank', () => {
    const window = new SampleWindow(100);
    for (let i = 100; i >= 1; i -= 1) window.push(i);
    expect(window.percentile(0)).toBe(1);
    expect(window.percentile(0.5)).toBe(50);
    expect(window.percentile(0.95)).toBe(95);
    expect(window.percentile(1)).toBe(100);
  });

  it('Push_BeyondTheCapacity_ForgetsTheOldest', () => {
    const window = new SampleWindow(2);
    for (const value of [100, 1, 2]) window.push(value);
    expect(window.percentile(1)).toBe(2);
  });
});
