import { describe, expect, it } from 'vitest';

import { Resume, type Shelf, type Tabs, type Word } from '../../src/protocol/resume';

function fakeShelf(kept: [string, string][] = []): Shelf {
  const items = new Map(kept);
  return {
    getItem: (key) => items.get(key) ?? null,
    removeItem: (key) => void items.delete(key),
    setItem: (key, value) => void items.set(key, value),
  };
}

function fakeTabs(): { tabs: () => Tabs } {
  const all: ((word: Word) => void)[][] = [];
  return {
    tabs: () => {
      const mine: ((word: Word) => void)[] = [];
      all.push(mine);
      return {
        post: (word) => all.filter((one) => one !== mine).forEach((one) => one.forEach((heard) => heard(word))),
        listen: (heard) => mine.push(heard),
      };
    },
  };
}

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

  it('Tab_IsDuplicated_BeginsAnew_AndTheFirstKeepsItsSession', async () => {
    const { tabs } = fakeTabs();
    const first = new Resume(fakeShelf(), '', tabs());
    first.keep('secret');
    const copy = fakeShelf([['froxel.resume.', 'secret']]);
    const second = new Resume(copy, '', tabs());
    await second.claim(10_000); // the answer ends it
    expect(second.token).toBe('');
    expect(first.token).toBe('secret');
    second.keep('another');
    expect(copy.getItem('froxel.resume.')).toBe('another');
  });

  it('Tab_IsReloaded_NobodyAnswers_SoItTakesItsSessionUp', async () => {
    const { tabs } = fakeTabs();
    const other = new Resume(fakeShelf(), '', tabs());
    other.keep('of another tab');
    const reloaded = new Resume(fakeShelf([['froxel.resume.', 'secret']]), '', tabs());
    await reloaded.claim(1);
    expect(reloaded.token).toBe('secret');
    await new Resume(null, '', null).claim(10_000); // nothing to wait for
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
