// What a new viewer tries in the first minutes: to drag, to get lost, to find the way back, to share.

import { expect, it } from 'vitest';

import { Renderer } from '../src/gen/froxel/v1/common_pb';
import { usePages } from './pages';
import { until, type Viewer } from './viewer';

const kStill = '#size=320x180&animate=0&lights=50';

const pages = usePages();

type Point = readonly [number, number, number];

const pointOf = (v: { x: number; y: number; z: number } | undefined): Point => [v?.x ?? 0, v?.y ?? 0, v?.z ?? 0];
const distance = (a: Point, b: Point): number => Math.hypot(...a.map((value, i) => value - (b[i] ?? 0)));
const eye = ({ state }: Viewer): Point => pointOf(state?.eye);
const target = ({ state }: Viewer): Point => pointOf(state?.target);

async function drag({ page }: Viewer, dx: number, dy = 0): Promise<void> {
  await page.mouse.move(640, 300);
  await page.mouse.down();
  for (let i = 1; i <= 10; i += 1) await page.mouse.move(640 + (dx * i) / 10, 300 + (dy * i) / 10);
  await page.mouse.up();
}

it('DragInsideTheHall_LooksAround_AndWithAltOrbits', async () => {
  const viewer = await pages.open(kStill);
  const before = eye(viewer);
  const ahead = target(viewer);
  await drag(viewer, 160);
  await viewer.settled();
  expect(distance(eye(viewer), before)).toBeLessThan(1e-3);
  expect(distance(target(viewer), ahead)).toBeGreaterThan(0.1);
  await viewer.page.keyboard.down('Alt');
  await drag(viewer, 160);
  await viewer.page.keyboard.up('Alt');
  await viewer.settled();
  expect(distance(eye(viewer), before)).toBeGreaterThan(0.1);
});

it('120NotchesOfTheWheel_LeaveTheSceneInThePicture_AndHomeLeadsBack', async () => {
  const viewer = await pages.open(kStill);
  const first = await viewer.settled();
  const before = eye(viewer);
  await viewer.page.mouse.move(640, 300);
  for (let i = 0; i < 120; i += 1) await viewer.page.mouse.wheel(0, 120);
  await viewer.settled();
  const { scene } = viewer.received.flatMap(({ body }) => (body.case === 'welcome' ? [body.value] : []))[0] ?? {};
  const diagonal = distance(pointOf(scene?.bounds?.min), pointOf(scene?.bounds?.max));
  const far = distance(eye(viewer), before);
  expect(far).toBeGreaterThan(2 * diagonal);
  expect(far).toBeLessThan(11 * diagonal);
  expect(await viewer.page.locator('#banner.error').isVisible()).toBe(false);
  await viewer.page.keyboard.press('h');
  await viewer.stateWith('the first eye', () => distance(eye(viewer), before) < 1e-3);
  const again = await viewer.settled();
  expect(Math.max(...again.map((value, i) => Math.abs(value - (first[i] ?? 0))))).toBeLessThan(40);
});

it('Fit_AndHome_AreInTheSearchAndInTheTools', async () => {
  const viewer = await pages.open(kStill);
  const before = eye(viewer);
  const found = async (text: string): Promise<string> => {
    await viewer.page.keyboard.press('Control+k');
    await viewer.page.locator('#search-text').fill(text);
    return (await viewer.page.locator('#search-list [aria-selected=true] b').textContent()) ?? '';
  };
  expect(await found('fit')).toBe('Fit');
  await viewer.page.keyboard.press('Enter');
  await viewer.stateWith('all of the hall', () => distance(eye(viewer), before) > 1);
  expect(await found('reset view')).toBe('Home');
  await viewer.page.keyboard.press('Escape');
  await viewer.page.locator('#tool-home').click();
  await viewer.stateWith('the first eye', () => distance(eye(viewer), before) < 1e-3);
});

it('DoubleClickOnNothing_GoesHome_WithoutAWord', async () => {
  const viewer = await pages.open('#size=320x180&animate=0&lights=0');
  const before = eye(viewer);

  await viewer.page.keyboard.press('o');
  await viewer.stateWith('all of the hall', () => distance(eye(viewer), before) > 1);
  await viewer.settled();
  await viewer.page.mouse.dblclick(20, 400);
  await viewer.stateWith('the first eye', () => distance(eye(viewer), before) < 1e-3);
  expect(await viewer.page.locator('#banner.error').isVisible()).toBe(false);
});

it('BackToDefaults_TakesTheCameraBackToo', async () => {
  const viewer = await pages.open(kStill);
  const before = eye(viewer);
  await viewer.page.keyboard.press('Shift+ArrowLeft');
  await viewer.stateWith('another eye', () => distance(eye(viewer), before) > 1e-3);
  await viewer.openPanel();
  await viewer.page.getByRole('button', { name: 'Back to the server’s defaults' }).click();
  await viewer.stateWith('the first eye', () => distance(eye(viewer), before) < 1e-3);
});

it('LinkToAViewWithoutTheScene_ShowsTheFirstView_AndSaysSo', async () => {
  const viewer = await pages.open(`${kStill}&eye=14393157,2,0&target=24393157,2,0`);
  await viewer.told('shows nothing of the scene');
  expect(Math.hypot(...eye(viewer))).toBeLessThan(1e3);
});

it('DragHint_ComesOnce_AndGoesWhenThePictureIsTouched', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.locator('#hint').waitFor();
  await viewer.page.mouse.click(640, 300);
  await viewer.page.locator('#hint').waitFor({ state: 'hidden' });
  await viewer.page.reload();
  await viewer.page.waitForTimeout(4_000); // longer than it waits for
  expect(await viewer.page.locator('#hint').isVisible()).toBe(false);
});

it('DragHint_NotWithLessMotion', async () => {
  const viewer = await pages.open(kStill, { reducedMotion: 'reduce' });
  await viewer.page.waitForTimeout(4_000);
  expect(await viewer.page.locator('#hint').isVisible()).toBe(false);
});

it('Renderers_AreChosenWithTwoClicks_AndByKey_WhichSaysWhatItIs', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.locator('#tool-renderers').click();
  const items = viewer.page.locator('#renderers-list button');
  await until('five', async () => (await items.count()) === 5);
  await items.filter({ hasText: 'light by light' }).click();
  await viewer.told('Drawn by: Toon, light by light.');
  await viewer.stateWith('toon', ({ renderer }) => renderer === Renderer.TOON_FRAGMENT);
  await viewer.page.locator('#view').press('r');
  await viewer.told('Drawn by: Toon, brightness in steps.');
  await viewer.stateWith('the other toon', ({ renderer }) => renderer === Renderer.TOON_COMPUTE);
});

it('EveryRenderer_DrawsTheViewThatThePageOpensWith', async () => {
  const viewer = await pages.open('#size=320x180');
  for (let i = 0; i < 5; i += 1) {
    const asked = viewer.sent.length;
    await viewer.page.locator('#view').press('r');
    await until('the command', () => viewer.sent.slice(asked).some(({ body }) => body.case === 'setRenderer'));
    await viewer.settled();
    expect(await viewer.page.locator('#banner.error').isVisible()).toBe(false);
  }
});

it('StillView_SaysSo', async () => {
  const viewer = await pages.open(kStill);
  await viewer.settled();
  await until('the word', async () => (await viewer.page.locator('#stat-fps').textContent()) === 'still');
  expect(await viewer.page.locator('#stats-head').innerText()).not.toMatch(/fps|ms/);
});

it('Picture_InASizeOfTheServers_IsSaved', async () => {
  const viewer = await pages.open(kStill);
  await viewer.settled();
  await viewer.page.locator('#tool-screenshot').click();
  const coming = viewer.page.waitForEvent('download');
  await viewer.page.locator('#pictures-list button').filter({ hasText: '1280 × 720' }).click();
  const saved = await coming;
  expect(saved.suggestedFilename()).toMatch(/^froxel-.*\.png$/);
});

it('PlacedLight_IsInTheLink_WhichSaysThatItLeadsNowhereElse', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.keyboard.press('Control+k');
  await viewer.page.locator('#search-text').fill('add a light');
  await viewer.page.keyboard.press('Enter');
  await until('the address', () => viewer.page.url().includes('placed_lights'));
  expect(viewer.page.url().length).toBeLessThan(700);
  await viewer.page.locator('#tool-link').click();
  await viewer.told('does not work on other computers');
  const other = await pages.open(new URL(viewer.page.url()).hash);
  expect(other.received.some(({ body }) => body.case === 'state' && (body.value.placedLights?.lights.length ?? 0) > 0)).toBe(true);
});

it('Room_IsOpenedByItsButton_AndAWatcherWhoDragsIsToldWhy', async () => {
  const first = await pages.open(kStill);

  await first.page.locator('#tool-room').click();
  await first.page.locator('#room-name').fill('meeting');
  await first.page.locator('#room-form button').click();
  await first.page.waitForURL(/room=meeting/);
  await until('the room', async () => (await first.page.locator('#room-text').textContent())?.includes('You control'));
  const second = await pages.open('?room=meeting');
  await drag(second, 100);
  await second.told('Ask for control to move it.');
  await second.page.locator('#room-request').click();
  await first.page.locator('#room-members button').click();
  await until('control', async () => (await second.page.locator('#room-text').textContent())?.includes('You control'));
  await second.page.locator('#room-leave').click();
  await second.page.waitForURL((url) => !url.search.includes('room'));
});

it.each([
  ['320 px', { width: 320, height: 568 }],
  ['200 %', { width: 640, height: 360 }],
])('Tools_At%s_DoNotTouch_AndHelpOpensAtItsBeginning', async (_, viewport) => {
  const viewer = await pages.open(kStill, { viewport });
  const boxes = await viewer.page.locator('#tools button:visible').evaluateAll((buttons) =>
    buttons.map((button) => {
      const text = document.createRange();
      text.selectNodeContents(button);
      const { left, right, top, bottom } = text.getBoundingClientRect();
      return { left, right, top, bottom };
    }),
  );
  for (const [i, a] of boxes.entries()) {
    for (const b of boxes.slice(i + 1)) {
      const apart = a.right + 1 < b.left || b.right + 1 < a.left || a.bottom <= b.top || b.bottom <= a.top;
      expect(apart).toBe(true);
    }
  }
  await viewer.page.locator('#tool-help').click();
  await viewer.page.locator('#help-title').waitFor();
  expect(await viewer.page.locator('#help').evaluate((help) => help.scrollTop)).toBe(0);
});
