// The stream's JPEG: what its bytes buy.

import * as Plot from '@observablehq/plot';

import { bytes } from '../src/core/format';
import { kMargin, xAxis, yAxis } from './axes';
import type { Row, StreamError } from './results';
import { logAxis, shortNumber } from './scales';
import { table } from './table';
import { errorText, msText } from './text';

interface Encoded {
  readonly series: string;
  readonly stream: StreamError;
}

const encodedOf = (rows: readonly Row[]): Encoded[] =>
  rows.flatMap(({ series, stream }) => (stream ? [{ series, stream }] : []));

const psnrOf = ({ shown }: StreamError): string => shown.psnr_db?.toFixed(1) ?? 'equal';

const tipOf = ({ series, stream }: Encoded): string =>
  [
    `quality ${stream.quality}, chroma ${series}`,
    `${bytes(stream.bytes)}, ${shortNumber(stream.bits_per_pixel)} bits a pixel`,
    `FLIP ${errorText(stream.perceived.flip)}, PSNR ${psnrOf(stream)}`,
  ].join('\n');

export interface StreamPlotOptions {
  readonly width: number;
  readonly colours: ReadonlyMap<string, string>;
}

/** FLIP by bits a pixel, a line a chroma, each point with its quality. */
export function streamPlot(
  rows: readonly Row[],
  { width, colours }: StreamPlotOptions,
): SVGElement {
  const encoded = encodedOf(rows);
  const x = logAxis(encoded.map(({ stream }) => stream.bits_per_pixel));
  const flipOf = ({ stream }: Encoded): number => stream.perceived.flip ?? NaN;
  const bitsOf = ({ stream }: Encoded): number => stream.bits_per_pixel;
  const colour = ({ series }: Encoded): string => colours.get(series) ?? 'var(--muted)';
  return Plot.plot({
    width,
    height: Math.min(400, Math.max(260, width * 0.5)),
    ...kMargin,
    x: { type: 'log', domain: [...x.domain], inset: 12 },
    y: { domain: [0, Math.max(...encoded.map(flipOf)) * 1.1] },
    marks: [
      ...yAxis('mean LDR-FLIP against the original picture'),
      ...xAxis('bits a pixel', x.ticks),
      Plot.line(encoded, { x: bitsOf, y: flipOf, z: 'series', stroke: colour, strokeWidth: 2 }),
      Plot.dot(encoded, { x: bitsOf, y: flipOf, fill: colour, r: 4 }),
      Plot.tip(
        encoded,
        Plot.pointer({
          x: bitsOf,
          y: flipOf,
          title: tipOf,
        }),
      ),
    ],
  }) as SVGElement;
}

export const streamTable = (rows: readonly Row[]): HTMLElement =>
  table(encodedOf(rows), [
    { head: 'chroma', text: ({ series }) => series },
    { head: 'quality', text: ({ stream }) => String(stream.quality), number: true },
    { head: 'size', text: ({ stream }) => bytes(stream.bytes), number: true },
    { head: 'bits/pixel', text: ({ stream }) => stream.bits_per_pixel.toFixed(2), number: true },
    {
      head: 'encoding, ms',
      text: ({ stream }) => msText(stream.encode_us.median / 1000),
      number: true,
    },
    { head: 'largest', text: ({ stream }) => errorText(stream.shown.max_abs), number: true },
    {
      head: 'PSNR, dB',
      text: ({ stream }) => psnrOf(stream),
      number: true,
    },
    {
      head: 'MSSIM',
      text: ({ stream }) => stream.perceived.mssim?.toFixed(4) ?? '–',
      number: true,
    },
    { head: 'FLIP', text: ({ stream }) => errorText(stream.perceived.flip), number: true },
  ]);
