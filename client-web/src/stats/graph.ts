// The live graph of frame interval and input latency over the last frames.

import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';

import { axisText } from '../core/format';
import type { History } from './stats';

const kDigitPx = 5.6; // of the axis's font
const widest = (texts: string[] | null): number =>
  12 + kDigitPx * Math.max(0, ...(texts ?? []).map(({ length }) => length));

export class Graph {
  private readonly plot: uPlot;

  constructor(parent: HTMLElement, width: number, height: number) {
    const colour = (name: string): string =>
      getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    const axis: uPlot.Axis = {
      stroke: () => colour('--muted'),
      font: '10px system-ui',
      grid: { stroke: () => colour('--edge'), width: 1 },
      ticks: { show: false },
    };
    const line = (label: string, token: string, points: boolean): uPlot.Series => ({
      label,
      stroke: () => colour(token),
      width: 1.5,
      spanGaps: true,
      points: { show: points, size: 3 },
    });
    this.plot = new uPlot(
      {
        width,
        height,
        padding: [6, 4, 2, 0],
        cursor: { show: false },
        legend: { show: false },
        scales: { x: { time: false }, y: { range: (_, __, max) => [0, Math.max(20, max * 1.1)] } },
        axes: [
          { ...axis, show: false },
          { ...axis, size: (_, texts) => widest(texts), space: 22, values: (_, splits) => splits.map(axisText) },
        ],
        series: [
          {},
          line('frame interval', '--accent', false),
          line('input to picture', '--second', false),
        ],
      },
      [[], [], []],
      parent,
    );
  }

  show({ timeS, intervalMs, latencyMs }: History): void {
    this.plot.setData([timeS, intervalMs, latencyMs]);
  }
}
