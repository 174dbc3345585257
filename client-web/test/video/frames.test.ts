import { describe, expect, it } from 'vitest';

import { frameCount, inOrder, kMostFrames, patiently, problemOf, type Answer } from '../../src/video/frames';

const answer = (status: number, retryAfter: string | null = null): Answer => ({
  ok: status === 200,
  status,
  headers: { get: () => retryAfter },
});

describe('recording', () => {
  it('FrameCount_IsWhole_AndAtLeastOne', () => {
    expect(frameCount(2, 30)).toBe(60);
    expect(frameCount(0.001, 30)).toBe(1);
  });

  it('Problem_NamesTheNumberOfFrames_AndTheLimit', () => {
    expect(problemOf(10, 30)).toBe('');
    expect(problemOf(NaN, 30)).toContain('more than 0');
    expect(problemOf(0, 30)).toContain('more than 0');
    expect(problemOf(kMostFrames, 1)).toBe('');
    expect(problemOf(200, 30)).toMatch(/^6000 frames are too many; .* 3600\./);
  });

  it('BusyServer_IsAskedAgain_WhenItSays', async () => {
    const answers = [answer(429, '3'), answer(503, null), answer(200)];
    const waits: number[] = [];
    const got = await patiently(
      () => Promise.resolve(answers.shift() ?? answer(500)),
      (seconds) => {
        waits.push(seconds);
        return Promise.resolve();
      },
    );
    expect(got.status).toBe(200);
    expect(waits).toEqual([3, 1]);
  });

  it('OtherAnswers_AreTheCallers_AndPatienceEnds', async () => {
    const wait = (): Promise<void> => Promise.resolve();
    expect((await patiently(() => Promise.resolve(answer(400)), wait)).status).toBe(400);
    let asked = 0;
    const busy = await patiently(() => {
      asked += 1;
      return Promise.resolve(answer(429, '1'));
    }, wait);
    expect([busy.status, asked]).toEqual([429, 20]);
  });

  it('Frames_ComeInOrder_AFewAhead', async () => {
    let under = 0;
    let most = 0;
    const taken: number[] = [];
    await inOrder(
      10,
      async (index) => {
        under += 1;
        most = Math.max(most, under);
        await new Promise((done) => setTimeout(done, (index % 3) * 2)); // later ones come sooner
        under -= 1;
        return index;
      },
      (frame) => {
        taken.push(frame);
        return Promise.resolve();
      },
      new AbortController().signal,
    );
    expect(taken).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
    expect(most).toBe(3);
  });

  it('FrameThatFails_EndsIt_WithItsReason', async () => {
    const taken: number[] = [];
    const all = inOrder(
      5,
      (index) => (index === 2 ? Promise.reject(new Error('too large')) : Promise.resolve(index)),
      (frame) => {
        taken.push(frame);
        return Promise.resolve();
      },
      new AbortController().signal,
    );
    await expect(all).rejects.toThrow('too large');
    expect(taken).toEqual([0, 1]);
  });

  it('Cancel_EndsIt_BeforeTheNextFrame', async () => {
    const cancel = new AbortController();
    const taken: number[] = [];
    const all = inOrder(
      100,
      (index) => Promise.resolve(index),
      (frame) => {
        taken.push(frame);
        if (frame === 3) cancel.abort(new Error('cancelled'));
        return Promise.resolve();
      },
      cancel.signal,
    );
    await expect(all).rejects.toThrow('cancelled');
    expect(taken).toEqual([0, 1, 2, 3]);
  });
});
