import { describe, expect, it } from 'vitest';

import { Later } from '../../src/core/later';

describe('Later', () => {
  it('Part_IsFetchedOnceHoweverOftenItIsWanted', async () => {
    let fetched = 0;
    const later = new Later(
      () => Promise.resolve((fetched += 1)),
      () => undefined,
    );
    expect(later.here).toBeNull();
    expect(await Promise.all([later.want(), later.want()])).toEqual([1, 1]);
    expect(await later.want()).toBe(1);
    expect(later.here).toBe(1);
  });

  it('Failure_IsToldAndTheNextWantTriesAgain', async () => {
    let [reachable, failures] = [false, 0];
    const later = new Later(
      () => (reachable ? Promise.resolve('part') : Promise.reject(new Error('404'))),
      () => (failures += 1),
    );
    later.ahead();
    await Promise.resolve();
    await Promise.resolve();
    expect(failures).toBe(0); // nobody has asked for it
    expect(await later.want()).toBeNull();
    expect(later.here).toBeNull();
    expect(failures).toBe(1);
    reachable = true;
    expect(await later.want()).toBe('part');
    expect(failures).toBe(1);
  });
});
