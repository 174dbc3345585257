import { create } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { differenceText, passesText, rightText } from '../../src/cards/compare_bar';
import { ComparedSchema } from '../../src/gen/froxel/v1/server_pb';

describe('compare bar', () => {
  it('EqualPictures_AreToldWithTheirPixels', () => {
    expect(differenceText(create(ComparedSchema, { flip: 0, promised: true }), 230_400)).toBe(
      'Equal, 230\u2009400 pixels compared',
    );
  });

  it('Difference_IsToldWithItsFirstPixel', () => {
    const compared = create(ComparedSchema, {
      differing: 2304n,
      max: 10 / 255,
      rmse: 0.00123456,
      first: { x: 3, y: 1, left: 0x3d0104, right: 0x000001 },
    });
    const words = '2\u2009304 of 230\u2009400 pixels differ (1.00 %), by at most 10/255, RMSE 0.00123';
    const where = 'the first is (3, 1): #3d0104 and #000001';
    expect(differenceText(compared, 230_400)).toBe(`${words}, FLIP when the view rests; ${where}`);
    expect(differenceText({ ...compared, flip: 0.03, promised: true }, 230_400)).toBe(
      `They should be equal: ${words}, FLIP 0.0300; ${where}`,
    );
  });

  it('Passes_AreNamedInMilliseconds', () => {
    expect(passesText([{ name: 'light_lists', gpuUs: 900 }, { name: 'lighting' }])).toBe('light lists 0.90 · lighting –');
    expect(rightText('light_cutoff:0.02,list_cap:8')).toBe('light cutoff 0.02, list cap 8');
  });
});
