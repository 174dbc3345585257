import { describe, expect, it } from 'vitest';

import { DrawCost } from '../../src/warp/draw_cost';

/** After so many draws that take so long. */
function costOf(draws: number, drawMs: number): { slowMs: number | null; finished: number } {
  const cost = new DrawCost();
  let [nowMs, undone, finished] = [0, 0, 0];
  const finish = (): void => {
    nowMs += undone;
    undone = 0;
    finished += 1;
  };
  for (let i = 0; i < draws; i += 1) cost.draw(() => void (undone += drawMs), finish, () => nowMs);
  return { slowMs: cost.slowMs, finished };
}

describe('DrawCost', () => {
  it.each([
    [149, 80, null],
    [150, 80, 80],
    [150, 20, null],
  ])('%dDraws_Of%dMs', (draws, drawMs, slowMs) => {
    expect(costOf(draws, drawMs).slowMs).toBe(slowMs);
  });

  it('FewDraws_AreWaitedFor', () => {
    expect(costOf(300, 5).finished).toBe(20);
  });
});
