import { describe, expect, it } from 'vitest';

import { kSliderSteps, linearScale, logScale, scaleFor } from '../../src/panel/range_scale';

const kReal = { kind: 'number', integer: false } as const;
const kWhole = { kind: 'number', integer: true } as const;

describe('scales', () => {
  it.each([
    ['linear', linearScale({ min: 1, max: 100 }, true)],
    ['log', logScale({ min: 0.001, max: 10_000 }, kReal, 2)],
    ['log from zero', logScale({ min: 0, max: 1000 }, kReal, 1)],
    ['log of whole numbers from zero', logScale({ min: 0, max: 1_000_000 }, kWhole, 1000)],
  ])('%s_NeverFallsAndComesBackToItsPosition', (_, scale) => {
    let last = -Infinity;
    for (let position = 0; position <= kSliderSteps; position += 1) {
      const value = scale.toValue(position);
      expect(value).toBeGreaterThanOrEqual(last);
      last = value;
      expect(scale.toValue(scale.toPosition(value))).toBeCloseTo(value, 1 - Math.log10(value + 1e-9));
    }
  });

  it('Ends_AreTheRange', () => {
    const scale = logScale({ min: 0, max: 1_000_000 }, kWhole, 1000);
    expect(scale.toValue(0)).toBe(0);
    expect(scale.toValue(kSliderSteps)).toBe(1_000_000);
    expect(scale.toPosition(0)).toBe(0);
    expect(scale.toPosition(1e9)).toBe(kSliderSteps);
  });
});

describe('a range', () => {
  const middle = (min: number, max: number): number | undefined =>
    scaleFor({ min, max }, kReal, 1)?.toValue(kSliderSteps / 2);

  it('OfDecades_HasALogarithmicSlider', () => {
    expect(middle(0.01, 100)).toBe(1);
    expect(middle(0, 100)).toBeLessThan(1);
  });

  it.each([
    ['list_cap', { min: 0, max: 65_535 }, kWhole, 256],
    ['light_speed', { min: 0, max: 100 }, kReal, 0.316],
  ])('OfDecadesFromNone_AsOf%s_HasALogarithmicSlider', (_, range, number, middleValue) => {
    const scale = scaleFor(range, number, 0);
    expect(scale?.toValue(0)).toBe(0);
    expect(scale?.toValue(kSliderSteps / 2)).toBe(middleValue);
    expect(scale?.toValue(kSliderSteps)).toBe(range.max);
  });

  it('WithALeastValueThatIsWorthAskingFor_StartsThereAfterZero', () => {
    const scale = scaleFor({ min: 0, max: 240 }, { ...kReal, softMin: 1 }, 0);
    expect(scale?.toValue(0)).toBe(0);
    expect(scale?.toValue(1)).toBeCloseTo(1, 1);
    expect(scale?.toValue(kSliderSteps / 2)).toBe(15.5); // of 1 and 240, the geometric mean
    expect(scale?.toPosition(0.2)).toBe(1); // what was typed
  });

  it('OfAnAngle_HasALinearSlider', () => {
    const scale = scaleFor({ min: -180, max: 180 }, { ...kReal, angle: true }, 0);
    expect(scale?.toValue(kSliderSteps / 2)).toBe(0);
    expect(scale?.toValue(kSliderSteps / 4)).toBe(-90);
  });

  it('OfOneKindOfSize_HasALinearSlider', () => {
    expect(middle(0, 1)).toBe(0.5);
    expect(middle(-0.95, 0.95)).toBe(0);
    expect(middle(64, 512)).toBe(288);
  });

  it('OfAnything_HasNone', () => {
    expect(middle(-1e7, 1e7)).toBeUndefined();
    expect(middle(-64, 64)).toBeUndefined();
    expect(middle(0, 4_294_967_295)).toBeUndefined();
  });
});
