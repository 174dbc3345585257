import { describe, expect, it } from 'vitest';

import { canvasSize } from '../../src/picture/picture';

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
