import { describe, expect, it } from 'vitest';

import { paretoFront } from '../../report/pareto';

const at = (x: number, y: number): { x: number; y: number } => ({ x, y });

describe('paretoFront', () => {
  it('NoPoint_HasNoFront', () => {
    expect(paretoFront([])).toEqual([]);
  });

  it('BeatenPoints_AreLeftOut', () => {
    const points = [at(3, 1), at(1, 3), at(2, 2), at(2.5, 2.5), at(4, 1)];
    expect(paretoFront(points)).toEqual([at(1, 3), at(2, 2), at(3, 1)]);
  });

  it('SameTime_TheMoreExactStays', () => {
    expect(paretoFront([at(1, 5), at(1, 2)])).toEqual([at(1, 2)]);
  });

  it('SameError_TheFasterStays', () => {
    expect(paretoFront([at(2, 0), at(1, 0)])).toEqual([at(1, 0)]);
  });

  it('EqualPoints_TheFirstStays', () => {
    const [first, second] = [at(1, 1), at(1, 1)];
    const front = paretoFront([first, second]);
    expect(front).toHaveLength(1);
    expect(front[0]).toBe(first);
  });

  it('PointsWithoutANumber_AreLeftOut', () => {
    expect(paretoFront([at(NaN, 1), at(1, NaN), at(2, 2)])).toEqual([at(2, 2)]);
  });

  it('Input_IsNotReordered', () => {
    const points = [at(2, 1), at(1, 2)];
    paretoFront(points);
    expect(points).toEqual([at(2, 1), at(1, 2)]);
  });

  it('EveryOtherPoint_IsBeatenByOneOnTheFront', () => {
    const points = Array.from({ length: 200 }, (_, i) => at((i * 7919) % 101, (i * 104_729) % 97));
    const front = paretoFront(points);
    for (const point of points) {
      expect(front.some(({ x, y }) => x <= point.x && y <= point.y)).toBe(true);
    }
    for (const one of front) {
      expect(
        points.some(({ x, y }) => (x < one.x && y <= one.y) || (x <= one.x && y < one.y)),
      ).toBe(false);
    }
  });
});
