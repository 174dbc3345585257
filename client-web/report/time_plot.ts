// Figures over the time of a load test.

import * as Plot from '@observablehq/plot';

import { kMargin, xAxis, yAxis } from './axes';
import type { LoadSecond } from './load_results';
import { shortNumber } from './scales';

export interface TimeLine {
  readonly name: string;
  readonly colour: string;
  readonly of: (second: LoadSecond) => number | null;
  readonly steps?: boolean; // a number of viewers has no values in between
}

const tipOf = (lines: readonly TimeLine[], second: LoadSecond): string =>
  [
    `at ${shortNumber(second.elapsed_s)} s`,
    ...lines.map((line) => `${line.name}: ${shortValue(line.of(second))}`),
  ].join('\n');

const shortValue = (value: number | null): string => (value === null ? 'none' : shortNumber(value));

/** A line for each figure; a second without a value leaves a gap. */
export function timePlot(
  series: readonly LoadSecond[],
  label: string,
  lines: readonly TimeLine[],
  width: number,
): SVGElement {
  const values = lines.flatMap((line) => series.map((second) => line.of(second) ?? 0));
  const last = series.at(-1)?.elapsed_s ?? 1;
  const x = ({ elapsed_s }: LoadSecond): number => elapsed_s;
  const top = lines[0];
  return Plot.plot({
    width,
    height: Math.min(260, Math.max(180, width * 0.35)),
    ...kMargin,
    x: { domain: [0, last] },
    y: { domain: [0, Math.max(...values, 1e-9) * 1.08] },
    marks: [
      ...yAxis(label),
      ...xAxis('seconds since the start'),
      ...lines.map((line) =>
        Plot.line(series, {
          x,
          y: (second: LoadSecond) => line.of(second) ?? NaN,
          stroke: line.colour,
          strokeWidth: 2,
          curve: line.steps ? 'step-before' : 'linear',
        }),
      ),
      // A line of one point is none.
      ...lines.map((line) =>
        Plot.dot(series.length === 1 ? series : [], { x, y: (second: LoadSecond) => line.of(second) ?? NaN, fill: line.colour, r: 4 }),
      ),
      ...(top
        ? [
            Plot.tip(
              series,
              Plot.pointerX({
                x,
                y: (second: LoadSecond) => top.of(second) ?? 0,
                title: (second: LoadSecond) => tipOf(lines, second),
              }),
            ),
          ]
        : []),
    ],
  }) as SVGElement;
}
