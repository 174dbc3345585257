import { describe, expect, it } from 'vitest';

import { Chroma, Refinement } from '../../src/gen/froxel/v1/common_pb';
import { deliveryRows } from '../../src/stats/delivery';
import { frameHeader } from '../fakes';

const values = (change: Parameters<typeof frameHeader>[0]): string[] =>
  deliveryRows(frameHeader(change)).map(({ value }) => value);

describe('deliveryRows', () => {
  it('MovingFrameOnASlowLink_TellsEveryStep', () => {
    const slow = {
      scale: 0.75,
      quality: 45,
      chroma: Chroma.CHROMA_420,
      refinement: Refinement.INTERACTIVE,
      rung: 4,
      queueDelayUs: 23_000,
      linkBitsPerS: 1_700_000n,
    };
    const [stage, scale, delay, link] = values(slow);
    expect(stage).toBe('moving · 45 · 4:2:0');
    expect(scale).toBe('75 % · 4');
    expect(delay).toMatch(/^23/);
    expect(link).toBe('1.7 Mbit/s');
    expect(values({ ...slow, linkBitsPerS: 320_000n })[3]).toBe('320 kbit/s');
  });

  it('LosslessFrame_HasNoQuality', () => {
    const rest = { scale: 1, quality: 0, chroma: Chroma.CHROMA_444 };
    expect(values({ ...rest, refinement: Refinement.LOSSLESS })[0]).toBe('lossless');
    expect(values({ ...rest, quality: 92, refinement: Refinement.HIGH })[0]).toBe('refined · 92 · 4:4:4');
    expect(values({ ...rest, quality: 92, refinement: Refinement.SMOOTH })[0]).toBe('smooth · 92 · 4:4:4');
  });

  it('GeometryErrorForTheTargetRate_HasARowOfItsOwn', () => {
    const rows = deliveryRows(frameHeader({ geometryErrorPx: 0.5 }));
    expect(rows).toContainEqual({ name: 'Geometry error', value: '0.5 px' });
    expect(deliveryRows(frameHeader({})).map(({ name }) => name)).not.toContain('Geometry error');
  });

  it('ServerThatSaysNothing_IsADash', () => {
    expect(values({})[0]).toBe('–');
    expect(values({})[3]).toBe('–');
  });
});
