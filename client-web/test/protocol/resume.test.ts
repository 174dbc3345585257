import { describe, expect, it } from 'vitest';

import { Resume, type Shelf } from '../../src/protocol/resume';

describe('Resume', () => {
  it('Token_IsKeptPerRoom_OutlivesAReload_AndGoesWhereTheServerKeepsNone', () => {
    const items = new Map<string, string>();
    const shelf: Shelf = {
      getItem: (key) => items.get(key) ?? null,
      removeItem: (key) => void items.delete(key),
      setItem: (key, value) => void items.set(key, value),
    };
    new Resume(shelf, 'hall').keep('secret');
    expect(new Resume(shelf, 'hall').token).toBe('secret');
    expect(new Resume(shelf, '').token).toBe('');
    new Resume(shelf, 'hall').keep('');
    expect(new Resume(shelf, 'hall').token).toBe('');
    expect(items.size).toBe(0);
  });

  it('Token_WithoutStorage_IsKeptInThePage', () => {
    const full: Shelf = {
      getItem: () => null,
      removeItem: () => undefined,
      setItem: () => {
        throw new DOMException('full', 'QuotaExceededError');
      },
    };
    for (const shelf of [null, full]) {
      const resume = new Resume(shelf, 'hall');
      resume.keep('secret');
      expect(resume.token).toBe('secret');
    }
  });
});
