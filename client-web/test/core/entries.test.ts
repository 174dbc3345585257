import { describe, expect, it } from 'vitest';

import { actionsOf, camerasOf, type Doings } from '../../src/actions';
import { entryOf, keyText, searched } from '../../src/core/entries';

const ran: string[] = [];
const does = new Proxy({} as Doings, {
  get: (_, name) => (index?: number) => void ran.push(index === undefined ? String(name) : `${String(name)} ${index}`),
});
const actions = actionsOf(does);
const all = [...actions, ...camerasOf(['nave', 'gallery'], does)];
const titles = (typed: string): string[] => searched(all, typed).map(({ title }) => title);

describe('entries', () => {
  it('Keys_AreOfOneActionEach_AndNoPlaceOfAFlyKeyOnQwerty', () => {
    const keys = all.map(({ key }) => key).filter((key) => key !== '');
    expect(new Set(keys).size).toBe(keys.length);
    for (const key of 'wasdqe') expect(keys).not.toContain(key);
  });

  it('EntryOf_TakesLettersInEitherCase_AndOthersAreNobodys', () => {
    entryOf('P', all)?.run();
    entryOf('2', all)?.run();
    expect(ran).toEqual(['screenshot', 'sceneCamera 1']);
    for (const other of ['', '0', 'Enter', 'constructor']) expect(entryOf(other, all)).toBeUndefined();
  });

  it('Search_HasTheBestFirst', () => {
    expect(titles('set')[0]).toBe('Settings');
    expect(titles('light').slice(0, 2)).toEqual(['Move or stop lights', 'Add a light']);
    expect(titles('toon')).toEqual(['Renderers', 'Next renderer']);
    expect(titles('camera GALLERY')).toEqual(['Camera gallery']);
    expect(titles('picture save')).toEqual(['Save picture', 'Save picture in a size']);
    expect(titles('xyzzy')).toEqual([]);
    expect(titles(' ').length).toBe(all.length);
  });

  it('EachHasAHelpThatStandsAlone', () => {
    for (const { title, help } of all) {
      expect(help, title).toMatch(/^[A-Z]\w+( \S+){2,}$/);
    }
  });

  it('KeyText_IsAsPeopleReadIt', () => {
    expect(all.filter(({ key }) => key === ' ' || key === 'p').map(keyText)).toEqual(['P', 'Space']);
  });
});
