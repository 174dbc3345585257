// Axes and their grids as every plot has them.

import * as Plot from '@observablehq/plot';

import { shortNumber } from './scales';

const kTickSpacing = { x: 70, y: 40 } as const;

/** Below the plot, its label in the middle; `ticks` as on a logarithmic axis, or evenly spaced. */
export function xAxis(
  label: string,
  ticks?: readonly number[],
  text: (tick: number) => string = shortNumber,
): Plot.Markish[] {
  const where = ticks ? { ticks: [...ticks] } : { tickSpacing: kTickSpacing.x };
  return [
    Plot.axisX({
      ...where,
      // Plot's own formatting would leave out labels of a logarithmic axis.
      ...(ticks ? { text } : { tickFormat: text }),
      label,
      labelArrow: 'none',
      labelAnchor: 'center',
      tickSize: ticks ? 4 : 0,
    }),
  ];
}

/** Left of the plot with lines across it, its label on top. */
export function yAxis(
  label: string,
  ticks?: readonly number[],
  text: (tick: number) => string = shortNumber,
): Plot.Markish[] {
  const where = ticks ? { ticks: [...ticks] } : { tickSpacing: kTickSpacing.y };
  return [
    Plot.gridY({ ...where, className: 'grid' }),
    Plot.axisY({
      ...where,
      ...(ticks ? { text } : { tickFormat: text }),
      label,
      labelArrow: 'none',
      tickSize: 0,
    }),
  ];
}

export const xGrid = (ticks?: readonly number[]): Plot.Markish =>
  Plot.gridX({
    ...(ticks ? { ticks: [...ticks] } : { tickSpacing: kTickSpacing.x }),
    className: 'grid',
  });

/** Names left of rows. */
export const nameAxis = (text: (key: string) => string): Plot.Markish =>
  Plot.axisY({ tickSize: 0, label: null, tickFormat: text });

/** Room for the longest of the names left of rows. */
export const nameMargin = (names: readonly string[], width: number): number =>
  Math.min(Math.max(...names.map((name) => name.length)) * 6.6 + 16, width * 0.45);

/** Margins of a plot of points. */
export const kMargin = {
  marginTop: 32,
  marginRight: 18,
  marginBottom: 42,
  marginLeft: 54,
} as const;
