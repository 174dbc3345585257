import { describe, expect, it } from 'vitest';

import { dragged, evaluate, inserted, removed } from '../../src/panel/ramp';

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
