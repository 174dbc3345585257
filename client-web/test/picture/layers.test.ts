import { describe, expect, it } from 'vitest';

import { layerSize, stripsOf } from '../../src/picture/layers';

describe('layers', () => {
  const both = { width: 640, height: 720 };

  it('OnePicture_IsHalfAsHigh', () => {
    expect(layerSize(both)).toEqual({ width: 640, height: 360 });
  });

  it('Divider_ShowsTheUpperPictureLeftOfIt', () => {
    expect(stripsOf(0.25, both)).toEqual([
      { from: 0, begin: 0, end: 0.25 },
      { from: 360, begin: 0.25, end: 1 },
    ]);
    expect(stripsOf(0, both)).toEqual([{ from: 360, begin: 0, end: 1 }]);
    expect(stripsOf(1, both)).toEqual([{ from: 0, begin: 0, end: 1 }]);
  });
});
