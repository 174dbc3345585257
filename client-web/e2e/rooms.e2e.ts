// Two pages in one room: one steers, both see it, and control goes from one to the other.

import { expect, it } from 'vitest';

import { Renderer } from '../src/gen/froxel/v1/common_pb';
import { usePages } from './pages';
import { difference, until, type Viewer } from './viewer';

const kStill = '#size=320x180&animate=0&lights=50';

const pages = usePages();

const roomText = (viewer: Viewer, text: RegExp): Promise<true> =>
  until(`${String(text)} on the room's card`, async () => {
    const shown = await viewer.page.locator('#room-text').textContent();
    return text.test(shown ?? '') ? true : null;
  });

it('Room_TwoPages_OneSteersBothSee_AndControlIsHandedOver', async () => {
  const first = await pages.open(`?room=salon${kStill}`);
  const second = await pages.open('?room=salon');
  await roomText(first, /^You control room salon; 1 watches\.$/);
  await roomText(second, /^Viewer \d+ controls room salon; 1 watches\.$/);
  expect(await second.page.locator('#panel').getAttribute('inert')).not.toBeNull();

  await first.openPanel();
  await first.choose('renderer', 'toon compute');
  await second.stateWith('the renderer', (state) => state.renderer === Renderer.TOON_COMPUTE);
  const shown = await first.settled();
  await until('the same picture in both', async () => difference(await second.thumbnail(), shown) === 0);
  await first.screenshot('room');

  await second.page.locator('#room-request').click();
  await first.page.getByRole('button', { name: 'Give control' }).click();
  await roomText(second, /^You control/);
  await roomText(first, /^Viewer \d+ controls/);
  await second.openPanel();
  await second.choose('renderer', 'naive');
  await first.stateWith('the renderer', (state) => state.renderer === Renderer.NAIVE);
});

it('Room_ControllerLeaves_TheNextWhoAsksHasIt', async () => {
  const first = await pages.open(`?room=study${kStill}`);
  const second = await pages.open('?room=study');
  await roomText(second, /^Viewer \d+ controls/);
  await first.page.locator('#room-release').click();
  await roomText(second, /^Nobody controls room study/);
  await second.page.locator('#room-request').click();
  await roomText(second, /^You control/);
});
