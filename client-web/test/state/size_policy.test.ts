import { describe, expect, it } from 'vitest';

import { autoSize, sizeModeFor } from '../../src/state/size_policy';

describe('sizes', () => {
  const side = { min: 16, max: 4096 };

  it('Auto_IsTheCanvasTimesTheScale', () => {
    const size = autoSize({ width: 1001, height: 500 }, 0.5, side, side);
    expect(size).toEqual({ width: 501, height: 250 });
  });

  it('Auto_KeepsItsShapeWithinTheLimits', () => {
    const size = autoSize({ width: 8192, height: 1024 }, 1, side, side);
    expect(size).toEqual({ width: 4096, height: 512 });
    expect(autoSize({ width: 10, height: 10 }, 0.1, side, side)).toEqual({ width: 16, height: 16 });
  });

  it('FirstMode_CostsWhatTheServersDefaultCosts', () => {
    const budget = { width: 960, height: 540 };
    expect(sizeModeFor({ width: 1920, height: 1080 }, budget)).toEqual({ kind: 'auto', scale: 0.5 });
    expect(sizeModeFor({ width: 360, height: 740 }, budget)).toEqual({ kind: 'auto', scale: 1 });
  });
});
