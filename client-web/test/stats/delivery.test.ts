import { describe, expect, it } from 'vitest';

import { Chroma, Refinement } from '../../src/gen/froxel/v1/common_pb';
import { canvasSize } from '../../src/picture/picture';
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
  });

  it('ServerThatSaysNothing_IsADash', () => {
    expect(values({})[0]).toBe('–');
    expect(values({})[3]).toBe('–');
  });
});

describe('canvasSize', () => {
  it('FullPicture_GivesItsOwnSize', () => {
    expect(canvasSize({ width: 10, height: 10 }, { width: 1281, height: 719 }, 1)).toEqual({
      width: 1281,
      height: 719,
    });
    expect(canvasSize({ width: 10, height: 10 }, { width: 8, height: 4 }, 0).width).toBe(8);
  });

  it('ScaledPicture_KeepsTheCanvasToThePixel', () => {
    for (const width of [1280, 1281, 639]) {
      for (const scale of [0.85, 0.75, 0.7, 0.6, 0.5, 0.4]) {
        const canvas = { width, height: 719 };
        const part = { width: Math.round(width * scale), height: Math.round(719 * scale) };
        expect(canvasSize(canvas, part, scale)).toBe(canvas);
      }
    }
  });

  it('ScaledPictureOfAnotherSize_MakesRoomForTheWholeOne', () => {
    const canvas = { width: 320, height: 180 };
    expect(canvasSize(canvas, { width: 640, height: 360 }, 0.5)).toEqual({ width: 1280, height: 720 });
  });
});
