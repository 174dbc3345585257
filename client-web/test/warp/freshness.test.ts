import { expect, it } from 'vitest';

import { Freshness } from '../../src/warp/freshness';

it('PicturesWithinTwoFrames_AreFresh_UntilTheyTakeThree', () => {
  const freshness = new Freshness();
  expect([freshness.noteLatency(40), freshness.fresh]).toEqual([false, false]);
  expect([freshness.noteLatency(30), freshness.fresh]).toEqual([true, true]);
  expect([freshness.noteLatency(45), freshness.fresh]).toEqual([false, true]);
  expect([freshness.noteLatency(null), freshness.fresh]).toEqual([false, true]);
  expect([freshness.noteLatency(51), freshness.fresh]).toEqual([true, false]);
  expect([freshness.noteLatency(40), freshness.fresh]).toEqual([false, false]);
});

it('FastDisplay_HasShorterFrames', () => {
  const freshness = new Freshness();
  for (const ms of [100, 107, 107.5, 114, 300]) freshness.noteFrame(ms);
  freshness.noteLatency(20);
  expect(freshness.fresh).toBe(false); // 2 frames of 6.5 ms
  freshness.noteLatency(12);
  expect(freshness.fresh).toBe(true);
});
