// Two settings of one frame side by side: the divider by mouse, keys and touch, figures, heat map, link and room.

import { expect, it } from 'vitest';

import { CompareShow } from '../src/gen/froxel/v1/common_pb';
import type { FrameHeader } from '../src/gen/froxel/v1/server_pb';
import { usePages } from './pages';
import { until, type Viewer } from './viewer';

const kStill = '#size=320x180&animate=0&light_time=3&lights=60&renderer=clustered_deferred';
const kBright = `${kStill}&compare=exposure:8`;

const pages = usePages();

const compared = (viewer: Viewer, what: string, test: (header: FrameHeader) => boolean): Promise<true> =>
  until(what, () => viewer.lastFrame !== null && test(viewer.lastFrame));

/** Mean brightness of a tenth of the picture's width around a share of it, as it is painted. */
const brightness = (viewer: Viewer, at: number): Promise<number> =>
  viewer.page.evaluate((share) => {
    const canvas = document.querySelector('canvas');
    const context = canvas?.getContext('2d');
    if (!canvas || !context) return -1;
    const width = Math.floor(canvas.width / 10);
    const { data } = context.getImageData(Math.floor(share * canvas.width - width / 2), 0, width, canvas.height);
    return data.reduce((sum, value, i) => (i % 4 === 3 ? sum : sum + value), 0) / ((data.length / 4) * 3);
  }, at);

const split = (viewer: Viewer): Promise<number> =>
  viewer.page.locator('#compare-split').evaluate((input) => Number((input as HTMLInputElement).value));

const thumb = async (viewer: Viewer): Promise<{ x: number; y: number }> => {
  const [box, share] = [await viewer.page.locator('#compare-split').boundingBox(), await split(viewer)];
  if (!box) throw new Error('there is no divider');
  return { x: box.x + box.height / 2 + share * (box.width - box.height), y: box.y + box.height / 2 };
};

it('Card_AddsASetting_ToTheRightSide_AndTheLinkHasIt', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.locator('#tool-compare').click();
  await viewer.page.locator('#compare-add').selectOption('exposure');
  await viewer.page.getByLabel('Exposure on the right').fill('8');
  await viewer.page.getByLabel('Exposure on the right').press('Enter');
  await viewer.page.locator('#compare-card-close').click();
  await compared(viewer, 'a frame of both sides', ({ compared }) => (compared?.differing ?? 0n) > 10_000n);
  await viewer.settled();
  expect(await brightness(viewer, 0.75)).toBeGreaterThan(2 * (await brightness(viewer, 0.25)));
  await until('figures', async () => {
    const text = (await viewer.page.locator('#compare-difference').textContent()) ?? '';
    return /of 57.600 pixels differ .* RMSE 0\.\d+, FLIP 0\.\d+; the first is \(/.test(text);
  });
  expect(await viewer.page.locator('#compare-right').innerText()).toMatch(/Right: exposure 8\s+[\d.]+ ms/);
  await until('the link', () => viewer.page.url().includes('compare=exposure:8'));
  await viewer.screenshot('compare');
});

it('Divider_MovesByMouseKeysAndTouch_WithoutAnotherPicture', async () => {
  const viewer = await pages.open(kBright, { hasTouch: true });
  await compared(viewer, 'a frame of both sides', ({ compared }) => compared?.layered === true);
  await viewer.settled();
  const frames = viewer.frameCount;
  const dark = await brightness(viewer, 0.25);

  const from = await thumb(viewer);
  await viewer.page.mouse.move(from.x, from.y);
  await viewer.page.mouse.down();
  await viewer.page.mouse.move(from.x - 400, from.y, { steps: 4 });
  await viewer.page.mouse.up();
  expect(await split(viewer)).toBeLessThan(0.25);
  await until('the bright side under it', async () => (await brightness(viewer, 0.35)) > 2 * dark);

  await viewer.page.locator('#compare-split').focus();
  await viewer.page.keyboard.press('End');
  await until('the dark side alone', async () => (await brightness(viewer, 0.75)) < 2 * dark);
  await viewer.page.keyboard.press('Home');
  await until('the bright side alone', async () => (await brightness(viewer, 0.25)) > 2 * dark);

  const finger = await viewer.page.context().newCDPSession(viewer.page);
  const touch = async (type: 'touchStart' | 'touchMove' | 'touchEnd', x: number, y: number): Promise<void> => {
    await finger.send('Input.dispatchTouchEvent', { type, touchPoints: type === 'touchEnd' ? [] : [{ x, y }] });
  };
  const { x, y } = await thumb(viewer);
  await touch('touchStart', x, y);
  for (const step of [100, 300, 640]) await touch('touchMove', x + step, y);
  await touch('touchEnd', x + 640, y);
  await until('the divider at the finger', async () => Math.abs((await split(viewer)) - 0.5) < 0.05);
  await viewer.stateWith('the divider', ({ compareSplit }) => Math.abs(compareSplit - 0.5) < 0.05);
  expect(viewer.frameCount).toBe(frames);
});

it('HeatMap_IsOnePicture_AndEndBringsTheViewBack', async () => {
  const viewer = await pages.open(kBright);
  await viewer.page.locator('#compare-heat').check();
  await compared(viewer, 'a heat map', ({ compared }) => compared?.layered === false && (compared.flip ?? 0) > 0.05);
  expect(await viewer.page.locator('#compare-split').isVisible()).toBe(false);
  await viewer.page.locator('#compare-end').click();
  await compared(viewer, 'the view alone', ({ compared }) => compared === undefined);
  expect(await viewer.page.locator('#compare-figures').isVisible()).toBe(false);
  await until('a link without it', () => !viewer.page.url().includes('compare'));
});

it('Link_RestoresTheComparison', async () => {
  const viewer = await pages.open(`${kStill}&compare=light_loop:all_lights&compare_split=0.25`);
  await compared(viewer, 'equal sides', ({ compared }) => compared?.promised === true && compared.differing === 0n);
  await until('the words', async () => (await viewer.page.locator('#compare-difference').textContent()) === 'Equal, 57\u2009600 pixels compared');
  expect(await split(viewer)).toBe(0.25);
});

it('WrongComparison_IsToldInWords_AndTheViewStays', async () => {
  const viewer = await pages.open(`${kStill}&compare=seed:5`);
  await viewer.told('seed is the same on both sides of a comparison');
  await compared(viewer, 'the view alone', ({ compared }) => compared === undefined);
});

it('Room_EverybodySeesTheComparison_AndItsDivider', async () => {
  const first = await pages.open(`?room=lens${kBright}`);
  const second = await pages.open('?room=lens');
  await second.stateWith('the comparison', ({ compare }) => compare === 'exposure:8');
  await until('the bar', () => second.page.locator('#compare-figures').isVisible());
  expect(await second.page.locator('#compare').getAttribute('inert')).not.toBeNull();
  await first.page.locator('#compare-split').focus();
  await first.page.keyboard.press('End');
  await until('the divider', async () => (await split(second)) === 1);
  await first.page.locator('#compare-heat').check();
  await second.stateWith('the heat map', ({ compareShow }) => compareShow === CompareShow.HEAT_MAP);
  await compared(second, 'a heat map', ({ compared }) => compared?.layered === false);
});
