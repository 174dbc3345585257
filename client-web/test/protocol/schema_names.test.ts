import { describe, expect, it } from 'vitest';

import { ChromaSchema, RendererSchema } from '../../src/gen/froxel/v1/common_pb';
import { choicesOf } from '../../src/protocol/schema_names';

describe('choicesOf', () => {
  it('Enum_HasItsNamesWithoutTheirPrefix', () => {
    expect(choicesOf(RendererSchema).map(({ name }) => name)).toEqual([
      'naive',
      'forward_plus',
      'clustered_deferred',
      'toon_fragment',
      'toon_compute',
    ]);
    expect(choicesOf(ChromaSchema).map(({ name }) => name)).toEqual(['420', '444']);
  });
});
