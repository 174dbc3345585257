// What a frame was made with and what its link carries, as rows of the statistics card.

import { ms } from '../core/format';
import { Chroma, Refinement } from '../gen/froxel/v1/common_pb';
import type { FrameHeader } from '../gen/froxel/v1/server_pb';
import type { Row } from './details';

const kRefinements: Readonly<Partial<Record<Refinement, string>>> = {
  [Refinement.INTERACTIVE]: 'moving',
  [Refinement.SETTLED]: 'at rest',
  [Refinement.HIGH]: 'refined',
  [Refinement.SMOOTH]: 'smooth',
  [Refinement.LOSSLESS]: 'lossless',
};

/** "moving · 55 · 4:2:0"; nothing of quality where nothing is lost. */
function madeWith({ refinement, quality, chroma }: FrameHeader): string {
  const stage = kRefinements[refinement] ?? '–';
  if (quality === 0) return stage;
  return `${stage} · ${quality} · ${chroma === Chroma.CHROMA_444 ? '4:4:4' : '4:2:0'}`;
}

function linkText(bitsPerS: number): string {
  if (bitsPerS <= 0) return '–';
  return bitsPerS < 1e6 ? `${(bitsPerS / 1e3).toFixed(0)} kbit/s` : `${(bitsPerS / 1e6).toFixed(1)} Mbit/s`;
}

export function deliveryRows(header: FrameHeader): Row[] {
  const percent = Math.round(header.scale * 100);
  return [
    { name: 'Stage · quality', value: madeWith(header) },
    { name: 'Scale · rung', value: `${percent} % · ${header.rung}` },
    ...(header.geometryErrorPx > 0 ? [{ name: 'Geometry error', value: `${header.geometryErrorPx} px` }] : []),
    { name: 'Link delay', value: ms(header.queueDelayUs / 1000) },
    { name: 'Link at least', value: linkText(Number(header.linkBitsPerS)) },
  ];
}
