import { describe, expect, it } from 'vitest';

import { vec } from '../../src/core/vec3';
import { Glide } from '../../src/warp/glide';
import { warpCamera, type WarpCamera } from '../../src/warp/warp_matrix';

const at = (x: number): WarpCamera =>
  warpCamera({ eye: vec(x, 0, 0), right: vec(1, 0, 0), up: vec(0, 1, 0), halfHeight: 1, lensShiftX: 0, lensShiftY: 0 });

const kFrameMs = 1000 / 60;

/** Where the view is in each frame of two seconds, while the true one moves by 1 m a second. */
function shown(show: (nowMs: number) => number | undefined, arrive: (x: number, nowMs: number) => void, jitterMs: number): number[] {
  const places: number[] = [];
  let seed = 1;
  let [next, taken] = [100, 100];
  for (let nowMs = 0; nowMs < 3_000; nowMs += kFrameMs) {
    while (next <= nowMs) {
      arrive(taken / 1000, nowMs);
      taken += 1000 / 15;
      seed = (seed * 16_807) % 2_147_483_647;
      next = taken + jitterMs * (seed / 2_147_483_647);
    }
    if (nowMs > 1_000) places.push(show(nowMs) ?? 0);
  }
  return places;
}

/** How far the places are from a motion that is as even as theirs can be, root mean square in metres. */
function unevenness(places: readonly number[]): number {
  const mean = (values: readonly number[]): number => values.reduce((sum, value) => sum + value, 0) / values.length;
  const late = mean(places.map((x, i) => (i * kFrameMs) / 1000 - x));
  return Math.sqrt(mean(places.map((x, i) => ((i * kFrameMs) / 1000 - late - x) ** 2)));
}

describe('Glide', () => {
  it.each([0, 20, 40])('PicturesThatComeUpTo%dMsLate_MoveMoreEvenlyThanAsTheyCome', (jitterMs) => {
    let last = 0;
    const asTheyCome = unevenness(shown(() => last, (x) => void (last = x), jitterMs));
    const glide = new Glide();
    const gliding = unevenness(
      shown((nowMs) => glide.at(nowMs)?.eye.x, (x, nowMs) => glide.start(at(x), nowMs), jitterMs),
    );
    expect(gliding).toBeLessThan(0.7 * asTheyCome);
  });

  it('EndsAtThePicturesCamera_AsItCame', () => {
    const glide = new Glide();
    const [first, second] = [at(0), at(1)];
    glide.start(first, 1_000);
    expect(glide.at(1_000)).toBe(first);
    glide.start(second, 1_060);
    expect(glide.at(1_060)?.eye.x).toBe(0);
    expect(glide.at(1_090)?.eye.x).toBeCloseTo(0.5, 9);
    expect(glide.at(1_120)).toBe(second);
  });

  it.each([
    ['AfterAPause', 500],
    ['FreshPictures', 16],
  ])('%s_ShowAsTheyCome', (_, pauseMs) => {
    const glide = new Glide();
    glide.start(at(0), 1_000);
    const camera = at(1);
    glide.start(camera, 1_000 + pauseMs);
    expect(glide.at(1_000 + pauseMs)).toBe(camera);
  });

  it('PictureWithoutDepth_HasNoCamera', () => {
    const glide = new Glide();
    glide.start(at(0), 1_000);
    glide.start(null, 1_060);
    expect(glide.at(1_070)).toBeNull();
    glide.start(at(1), 1_120);
    expect(glide.at(1_120)?.eye.x).toBe(1);
  });
});
