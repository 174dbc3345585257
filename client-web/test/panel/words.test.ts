import { describe, expect, it } from 'vitest';

import { labelOf, tipOf, wordsOf, type WordBook } from '../../src/panel/words';

const kSilent: WordBook = new Map();
const book = wordsOf([
  { name: 'fog_base_height', label: 'Fog base', help: 'Where it is whole', unit: 'm', cost: '' },
  { name: 'bloom', label: '', help: 'How light is spread', unit: '', cost: 'mip_chain: least' },
]);

describe('words', () => {
  it('Label_IsTheNameAndTheUnit', () => {
    expect(labelOf('bloom_knee', kSilent)).toBe('Bloom knee');
    expect(labelOf('fog_base_height', kSilent)).toBe('Fog base height');
    expect(labelOf('fog_base_height', book)).toBe('Fog base, m');
  });

  it('Tip_IsWhatIsKnownOfHelpCostAndLimits', () => {
    expect(tipOf('bloom', book, '')).toBe('How light is spread · Costs: mip_chain: least');
    expect(tipOf('fog_base_height', book, '-5 to 5')).toBe('Where it is whole · -5 to 5');
    expect(tipOf('exposure', book, '0 to 1')).toBe('0 to 1');
    expect(tipOf('exposure', kSilent, '')).toBe('');
  });

  it('FieldBesideTheTable_HasWordsOfItsOwn', () => {
    expect(labelOf('grid.x', kSilent)).toBe('Tiles across');
    expect(tipOf('grid.x', kSilent, '1 to 128')).toBe('Number of clusters along the picture’s width · 1 to 128');
  });

  it('WhatIsNotUnderstood_IsLeftOut', () => {
    const read = wordsOf([null, 3, 'bloom', [], { help: 'of nothing' }, { name: 5 }, { name: 'a', help: 7, more: 1 }]);
    expect([...read]).toEqual([['a', { label: '', help: '', unit: '', cost: '', compares: false }]]);
    for (const json of [null, undefined, 'words', 5, { name: 'a' }]) expect(wordsOf(json).size).toBe(0);
  });
});
