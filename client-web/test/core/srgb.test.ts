import { describe, expect, it } from 'vitest';

import { displayColor, linearColor } from '../../src/core/srgb';
import { vec } from '../../src/core/vec3';

describe('colours', () => {
  it('LinearToDisplayAndBack_KeepsTheByte', () => {
    expect(displayColor(vec(1, 0, 0.2158605))).toBe('#ff0080');
    for (const color of ['#000000', '#0a0b0c', '#7f80ff']) {
      expect(displayColor(linearColor(color))).toBe(color);
    }
  });
});
