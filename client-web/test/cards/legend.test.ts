import { create } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { endsOf, gradientOf } from '../../src/cards/legend';
import { DebugLegendSchema } from '../../src/gen/froxel/v1/server_pb';

describe('legend', () => {
  it('Gradient_HasTheServersColours', () => {
    expect(gradientOf([0x000154, 0xfde725])).toBe('linear-gradient(to right, #000154, #fde725)');
  });

  it('Ends_HaveTheUnit', () => {
    const legend = create(DebugLegendSchema, { min: 0, max: 64, unit: 'lights' });
    expect(endsOf(legend)).toEqual(['0', '64 lights']);
  });
});
