// What the panel's controls stand on: scales, sizes, ramps, names.

import { describe, expect, it } from 'vitest';

import { bytes, count, gridText, ms, percent, tidy } from '../../src/core/format';
import { BloomKind, ChromaSchema, Renderer, RendererSchema } from '../../src/gen/froxel/v1/common_pb';
import { dragged, evaluate, inserted, removed } from '../../src/panel/ramp';
import { kSliderSteps, linearScale, logScale, scaleFor } from '../../src/panel/range_scale';
import { choicesOf } from '../../src/protocol/schema_names';
import { fieldsOf, isInUse, kAllFields, patchFor } from '../../src/settings/fields';
import { valueOf } from '../../src/settings/settings';
import { autoSize, sizeModeFor } from '../../src/state/size_policy';
import { sampleSettings } from '../sample';

describe('scales', () => {
  it.each([
    ['linear', linearScale({ min: 1, max: 100 }, true)],
    ['log', logScale({ min: 0.001, max: 10_000 }, false, 2)],
    ['log from zero', logScale({ min: 0, max: 1000 }, false, 1)],
    ['log of whole numbers from zero', logScale({ min: 0, max: 1_000_000 }, true, 1000)],
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
    const scale = logScale({ min: 0, max: 1_000_000 }, true, 1000);
    expect(scale.toValue(0)).toBe(0);
    expect(scale.toValue(kSliderSteps)).toBe(1_000_000);
    expect(scale.toPosition(0)).toBe(0);
    expect(scale.toPosition(1e9)).toBe(kSliderSteps);
  });
});

describe('a range', () => {
  const middle = (min: number, max: number): number | undefined =>
    scaleFor({ min, max }, false, 1)?.toValue(kSliderSteps / 2);

  it('OfDecades_HasALogarithmicSlider', () => {
    expect(middle(0.01, 100)).toBe(1);
    expect(middle(0, 100)).toBeLessThan(1);
  });

  it.each([
    ['list_cap', { min: 0, max: 65_535 }, true, 256],
    ['target_fps', { min: 0, max: 240 }, false, 0.49],
  ])('OfDecadesFromNone_AsOf%s_HasALogarithmicSlider', (_, range, integer, middleValue) => {
    const scale = scaleFor(range, integer, 0);
    expect(scale?.toValue(0)).toBe(0);
    expect(scale?.toValue(kSliderSteps / 2)).toBe(middleValue);
    expect(scale?.toValue(kSliderSteps)).toBe(range.max);
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

describe('ramps', () => {
  const ramp = [
    { x: 0.2, y: 0.1, slope: 0 },
    { x: 0.6, y: 0.9, slope: 2 },
    { x: 0.8, y: 0.5, slope: 0 },
  ];

  it('Curve_PassesItsPointsAndIsConstantOutside', () => {
    for (const { x, y } of ramp) expect(evaluate(ramp, x)).toBeCloseTo(y, 12);
    expect(evaluate(ramp, 0)).toBe(0.1);
    expect(evaluate(ramp, 1)).toBe(0.5);
  });

  it('Curve_HasTheGivenSlopes', () => {
    const h = 1e-6;
    for (const side of [-h, h]) {
      expect((evaluate(ramp, 0.6 + side) - 0.9) / side).toBeCloseTo(2, 3);
    }
  });

  it('Drag_StopsAtTheNeighboursAndTheSquare', () => {
    expect(dragged(ramp, 1, 5, 5)[1]).toEqual({ x: 0.799, y: 1, slope: 2 });
    expect(dragged(ramp, 1, -5, -5)[1]).toEqual({ x: 0.201, y: 0, slope: 2 });
    expect(dragged(ramp, 0, -5, 0)[0]?.x).toBe(0);
    expect(dragged(ramp, 2, 5, 0)[2]?.x).toBe(1);
  });

  it('Insert_PutsAPointOnTheCurveInTheGap', () => {
    const added = inserted(ramp, 0);
    expect(added.index).toBe(1);
    expect(added.ramp[1]).toEqual({ x: 0.4, y: evaluate(ramp, 0.4), slope: 0 });
    expect(inserted(ramp, 2).index).toBe(2);
  });

  it('Remove_TakesOnePoint', () => {
    expect(removed(ramp, 1)).toEqual([ramp[0], ramp[2]]);
  });
});

describe('names', () => {
  it('Choices_AreTheSchemasNamesWithoutPrefix', () => {
    expect(choicesOf(RendererSchema).map(({ name }) => name)).toEqual([
      'naive',
      'forward_plus',
      'clustered_deferred',
      'toon_fragment',
      'toon_compute',
    ]);
    expect(choicesOf(ChromaSchema).map(({ name }) => name)).toEqual(['420', '444']);
  });

  it('Fields_HaveEachNameOnceAndAValueInTheSettings', () => {
    const settings = sampleSettings();
    expect(new Set(kAllFields.map(({ name }) => name)).size).toBe(kAllFields.length);
    for (const field of kAllFields) expect(valueOf(settings, field)).toBeDefined();
  });

  it('Sections_HaveEveryFieldOnce', () => {
    const sections = ['camera', 'rendering', 'effects', 'lights', 'clusters', 'debug', 'stream'] as const;
    const names = sections.flatMap((section) => fieldsOf(section).map(({ name }) => name));
    expect(names.sort()).toEqual(kAllFields.map(({ name }) => name).sort());
  });

  it.each([
    ['bloom_knee', { bloom: BloomKind.MIP_CHAIN }],
    ['fog_albedo', { fogDensity: 1 }],
    ['outline_width', { renderer: Renderer.TOON_COMPUTE }],
    ['shadow_size', { shadowLights: 1 }],
    ['grid.x', { gridAutomatic: false }],
  ])('Field_%s_IsInUseOnlyWithWhatItBelongsTo', (name, change) => {
    const field = kAllFields.find((candidate) => candidate.name === name);
    if (!field) throw new Error(`no field ${name}`);
    expect(isInUse(field, sampleSettings())).toBe(false);
    expect(isInUse(field, sampleSettings(change))).toBe(true);
  });

  it('SideOfTheGrid_MakesItOneByHand', () => {
    const field = kAllFields.find(({ key }) => key === 'gridY');
    if (!field) throw new Error('no field for the tiles');
    expect(patchFor(field, 7)).toEqual({ gridY: 7, gridAutomatic: false });
  });

  it('AngleOfView_MakesTheProjectionPerspective', () => {
    const field = kAllFields.find(({ key }) => key === 'fovDeg');
    if (!field) throw new Error('no field for the angle');
    expect(patchFor(field, 60)).toEqual({ fovDeg: 60, orthographic: false });
  });
});

describe('format', () => {
  it('Milliseconds_HaveThreeDigitsOrSo', () => {
    expect([0, 1.234, 12.34, 123.4, null].map(ms)).toEqual(['0.00', '1.23', '12.3', '123', '–']);
  });

  it('Bytes_HaveAUnit', () => {
    expect([0, 999, 1500, 2.5e6, 3e12].map(bytes)).toEqual([
      '0 B',
      '999 B',
      '1.5 kB',
      '2.5 MB',
      '3000 GB',
    ]);
  });

  it('GridsAndShares_ReadAsPeopleWriteThem', () => {
    expect(gridText({ x: 16, y: 9, z: 24 })).toBe('16 × 9 × 24');
    expect([percent(1, 3), percent(0, 5), percent(1, 0)]).toEqual(['33.3 %', '0.00 %', '–']);
  });

  it('Tidy_RoundsFloatsButNoWholeNumbers', () => {
    expect(tidy(Math.fround(0.1))).toBe(0.1);
    expect(tidy(123_456_789)).toBe(123_456_789);
  });

  it('Counts_AreGroupedByThree', () => {
    expect(count(1_234_567n)).toBe('1\u2009234\u2009567');
    expect(count(12)).toBe('12');
  });
});
