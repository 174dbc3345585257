// Keys, fingers and screens that viewers guess wrong: whatever goes down comes up again, and sizes follow the screen.

import { expect, it } from 'vitest';

import { usePages } from './pages';
import { until, type Viewer } from './viewer';

const kStill = '#size=320x180&animate=0&lights=50';

const pages = usePages();

interface Pose {
  readonly eye: readonly number[];
  readonly target: readonly number[];
}

const distance = (a: readonly number[], b: readonly number[]): number =>
  Math.hypot(...a.map((value, i) => value - (b[i] ?? 0)));

/** The cameras that the page has sent. */
const poses = ({ sent }: Viewer): Pose[] =>
  sent.flatMap(({ body }) => {
    if (body.case !== 'setCamera') return [];
    const { eye, target } = body.value;
    const list = (v: typeof eye): number[] => (v ? [v.x, v.y, v.z] : []);
    return [{ eye: list(eye), target: list(target) }];
  });

const lastPose = (viewer: Viewer): Pose => {
  const pose = poses(viewer).at(-1);
  if (!pose) throw new Error('no camera was sent');
  return pose;
};

const moves = (viewer: Viewer, count: number): Promise<true> =>
  until(`${count} cameras`, () => poses(viewer).length >= count);

/** Waits until some more of the page's frames are over: whatever still moves would have told of it. */
async function framesPass({ page }: Viewer, count = 12): Promise<void> {
  await page.evaluate(
    (frames) =>
      new Promise<void>((done) => {
        const next = (left: number): void => {
          if (left === 0) done();
          else requestAnimationFrame(() => next(left - 1));
        };
        next(frames);
      }),
    count,
  );
}

async function standsStill(viewer: Viewer): Promise<void> {
  await viewer.settled();
  const before = poses(viewer).length;
  await framesPass(viewer);
  await viewer.settled();
  expect(poses(viewer).length).toBe(before);
}

/** A key of another layout: its place, and the letter that is there. */
const press = ({ page }: Viewer, type: 'keydown' | 'keyup', code: string, key: string): Promise<void> =>
  page.locator('#view').dispatchEvent(type, { code, key, bubbles: true, cancelable: true });

it('CommandWhileAFlyKeyIsDown_EndsTheFlight_ThoughNoKeyUpComes', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.keyboard.down('KeyW');
  await moves(viewer, 3);
  await viewer.page.keyboard.down('Meta');
  await viewer.page.keyboard.up('Meta');
  await standsStill(viewer);
  await viewer.page.keyboard.up('KeyW');
});

it('WindowLosesTheFocusWhileAFlyKeyIsDown_TheFlightEnds', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.keyboard.down('KeyD');
  await moves(viewer, 3);
  await viewer.page.evaluate(() => window.dispatchEvent(new Event('blur')));
  await standsStill(viewer);
});

// On Colemak the key S, which flies back, says "r", which is the next renderer's letter.
it('LetterOfAShortcutAtAPlaceOfFlight_Flies', async () => {
  const viewer = await pages.open(kStill);
  const renderer = viewer.state?.renderer;
  await press(viewer, 'keydown', 'KeyS', 'r');
  await moves(viewer, 3);
  await press(viewer, 'keyup', 'KeyS', 'r');
  await standsStill(viewer);
  expect(viewer.state?.renderer).toBe(renderer);
});

it('SingleLetters_OutsideThePicture_DoNothing', async () => {
  const viewer = await pages.open(kStill);
  const count = viewer.sent.filter(({ body }) => body.case === 'setRenderer').length;
  await viewer.page.locator('#tool-link').focus();
  await viewer.page.keyboard.press('r');
  await viewer.page.keyboard.press('w');
  await standsStill(viewer);
  expect(viewer.sent.filter(({ body }) => body.case === 'setRenderer').length).toBe(count);
  expect(poses(viewer)).toEqual([]);
});

it('CopiedLink_LeadsToThisView_AndHasAPictureOfIt', async () => {
  const viewer = await pages.open(`${kStill}&lights=7`);
  const context = viewer.page.context();
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await viewer.page.locator('#view').focus();
  await viewer.page.keyboard.press('l');
  await until('the word', async () =>
    (await viewer.page.locator('#banner-text').innerText()).includes('clipboard'),
  );
  const link = await viewer.page.evaluate(() => navigator.clipboard.readText());
  const preview = await (await context.request.get(link)).text();
  const picture = /og:image" content="([^"]+)"/.exec(preview)?.[1]?.replaceAll('&amp;', '&') ?? '';
  const still = await context.request.get(picture, { timeout: 120_000 });
  expect(still.status()).toBe(200);
  expect(still.headers()['content-type']).toBe('image/jpeg');

  const address = new URLSearchParams(new URL(viewer.page.url()).hash.slice(1));
  await viewer.page.goto(link);
  await until('the view', () => Promise.resolve(new URL(viewer.page.url()).pathname === '/'));
  const arrived = new URLSearchParams(new URL(viewer.page.url()).hash.slice(1));
  expect([...arrived]).toEqual([...address]);
});

it('Search_OverTheHelp_ClosesIt', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.keyboard.press('?');
  await until('the help', () => viewer.page.locator('#help').isVisible());
  await viewer.page.keyboard.press('Control+k');
  await until('the search', () => viewer.page.locator('#search').isVisible());
  expect(await viewer.page.locator('#help').isVisible()).toBe(false);
  await viewer.page.keyboard.press('Escape');
  expect(await viewer.page.locator('#search').isVisible()).toBe(false);
});

it('WindowOnAnotherScreen_TheSizeFollowsItsPixels', async () => {
  const viewer = await pages.open('#animate=0&lights=50&size=auto@0.25');
  await viewer.stateWith('320 × 180', ({ width, height }) => width === 320 && height === 180);
  const devtools = await viewer.page.context().newCDPSession(viewer.page);
  // Emulation tells a page of other pixels only together with another width; alone: window_size.test.ts.
  const screen = (width: number, deviceScaleFactor: number): Promise<unknown> =>
    devtools.send('Emulation.setDeviceMetricsOverride', { width, height: 720, mobile: false, deviceScaleFactor });
  await screen(1284, 2);
  await viewer.stateWith('642 × 360', ({ width, height }) => width === 642 && height === 360);
  await screen(1280, 1);
  await viewer.stateWith('320 × 180', ({ width, height }) => width === 320 && height === 180);
});

it('Fingers_OneTurns_TwoZoom_AndNothingIsLeftOverWhenTheyLift', async () => {
  const viewer = await pages.open(kStill, { hasTouch: true });
  const devtools = await viewer.page.context().newCDPSession(viewer.page);
  type Type = 'touchStart' | 'touchMove' | 'touchEnd';
  const touch = (type: Type, ...points: (readonly [number, number])[]): Promise<unknown> =>
    devtools.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });

  await touch('touchStart', [600, 300]);
  await touch('touchMove', [640, 300]);
  await touch('touchMove', [700, 320]);
  await moves(viewer, 1);
  await viewer.settled();
  const turned = lastPose(viewer);
  await touch('touchStart', [700, 320], [800, 320]);
  await touch('touchMove', [650, 320], [850, 320]);
  await until('a nearer camera', () => {
    const { eye, target } = lastPose(viewer);
    return distance(eye, target) < 0.9 * distance(turned.eye, turned.target);
  });
  await touch('touchEnd'); // one of two: input.test.ts
  await viewer.settled();
  const pinched = lastPose(viewer);
  await touch('touchStart', [650, 320]);
  await touch('touchMove', [690, 320]);
  await until('a turn', () => distance(lastPose(viewer).target, pinched.target) > 0);
  await viewer.settled();
  const { eye, target } = lastPose(viewer);
  expect(distance(eye, target) / distance(pinched.eye, pinched.target)).toBeCloseTo(1, 5);
  await touch('touchEnd');
  await viewer.page.mouse.move(300, 300);
  await viewer.page.mouse.move(500, 300);
  await standsStill(viewer);
});

it('RingOfALight_MovesByKeys_AndEscapeGoesBackToThePicture', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.keyboard.press('Control+k');
  await viewer.page.locator('#search-text').fill('add a light');
  await viewer.page.keyboard.press('Enter');
  const ring = viewer.page.locator('.handle');
  await ring.waitFor();
  const place = async (): Promise<number[]> => {
    await viewer.settled();
    const placed = viewer.received.flatMap(({ body }) => (body.case === 'state' ? (body.value.placedLights?.lights ?? []) : []));
    const at = placed.at(-1)?.position;
    return at ? [at.x, at.y, at.z] : [];
  };
  const first = await place();
  const eye = viewer.state?.eye;
  const from = eye ? [eye.x, eye.y, eye.z] : [];
  await ring.press('Shift+ArrowUp');
  await until('a farther light', async () => distance(await place(), from) > 1.01 * distance(first, from));
  const second = await place();
  await ring.press('ArrowRight');
  await until('a light beside', async () => distance(await place(), second) > 0);
  await ring.press('Escape');
  expect(await viewer.page.evaluate(() => document.activeElement?.id)).toBe('view');
  await viewer.page.keyboard.press('r');
  await until('a key of the picture', () => viewer.sent.some(({ body }) => body.case === 'setRenderer'));
});

it('LessMotion_BeginsWithLightsThatStandStill', async () => {
  const viewer = await pages.open('#size=320x180&lights=50', { reducedMotion: 'reduce' });
  await viewer.stateWith('still lights', ({ lightAnimate }) => !lightAnimate);
  const asked = await pages.open('#size=320x180&lights=50&animate=1', { reducedMotion: 'reduce' });
  await asked.stateWith('moving lights', ({ lightAnimate, lightCount }) => lightAnimate && lightCount === 50);
});
