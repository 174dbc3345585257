// What a viewer sees and does with the page as it opens.

import { execFile } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { promisify } from 'node:util';

import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';

import { LightPalette, LightPlaces } from '../src/gen/froxel/v1/common_pb';
import { parseAddress } from '../src/state/address';
import { usePages } from './pages';
import { difference, until, type Viewer } from './viewer';

const kStill = '#size=320x180&animate=0&lights=50';

const pages = usePages();

const open = (hash = kStill, options = {}): Promise<Viewer> => pages.open(hash, options);

it('Page_AsItOpens_ConnectsAndPaintsAndCounts', async () => {
  const viewer = await open('');
  expect(await viewer.page.title()).toBe('Froxel');
  await viewer.openFigures();
  await until('figures', async () => {
    const rate = await viewer.page.locator('#stat-fps').textContent();
    return viewer.frameCount > 10 && Number(rate) > 0 && (await viewer.page.locator('#passes-table tr').count()) > 0;
  });
  expect(await viewer.page.locator('#progress').isVisible()).toBe(false);
  expect(await viewer.page.locator('#banner').isVisible()).toBe(false);
  await viewer.screenshot('wide');
});

it('Picture_FollowsTheWindow_ToldOnce_WithinTheServersBudget', async () => {
  const viewer = await open('#animate=0&lights=50&size=auto@0.25');
  await viewer.stateWith('320 × 180', (state) => state.width === 320 && state.height === 180);
  const told = viewer.sent.flatMap(({ body }) => (body.case?.startsWith('set') ? [body.case] : []));
  expect(told).toContain('setLights');
  expect(told).toEqual([...new Set(told)]);
  await viewer.page.setViewportSize({ width: 800, height: 800 });
  await viewer.stateWith('200 × 200', (state) => state.width === 200 && state.height === 200);
});

it('Looks_AreChosen_LeaveNothingOfOthers_AndOwnOnesAreKept', async () => {
  const viewer = await open('#size=320x180&animate=0');
  const { page } = viewer;
  const choose = async (label: string): Promise<void> => {
    await page.locator('#view').focus();
    await page.keyboard.press('v');
    await page.locator('#looks-list').getByRole('button', { name: label, exact: true }).click();
  };
  await choose('Mist');
  await viewer.stateWith('mist', ({ fog, lightPalette }) =>
    (fog?.density ?? 0) > 0 && lightPalette === LightPalette.COOL);
  await page.locator('#tool-looks').click();
  await page.locator('#looks-name').fill('<b>Mine</b>');
  await page.keyboard.press('Enter');
  await page.locator('#looks-close').click();
  await choose('Evening');
  await viewer.stateWith('evening', ({ fog, lightPalette, lightPlaces, lightAnimate }) =>
    fog?.density === 0 && lightPalette === LightPalette.WARM && lightPlaces === LightPlaces.SURFACES && !lightAnimate);
  await page.reload();
  await viewer.picture();
  await choose('<b>Mine</b>');
  await viewer.stateWith('one of its own', ({ fog }) => (fog?.density ?? 0) > 0);
  await page.locator('#tool-looks').click();
  await page.getByRole('button', { name: 'Remove the look <b>Mine</b>' }).click();
  expect(await page.locator('#looks-list').textContent()).not.toContain('Mine');
});

it('Pointer_Wheel_AndKeys_MoveTheCamera', async () => {
  const viewer = await open();
  const { mouse, keyboard } = viewer.page;
  const moves: [string, (before: readonly number[]) => Promise<unknown>][] = [
    [
      'orbit',
      async () => {
        await keyboard.down('Alt'); // without it a drag in the hall looks around
        await mouse.move(600, 300);
        await mouse.down();
        await mouse.move(700, 340, { steps: 8 });
        await mouse.up();
        await keyboard.up('Alt');
      },
    ],
    ['wheel', () => mouse.wheel(0, 300)],
    [
      'pan',
      async () => {
        await mouse.down({ button: 'right' });
        await mouse.move(600, 400, { steps: 4 });
        await mouse.up({ button: 'right' });
      },
    ],
    [
      'fly',
      async (before) => {
        await keyboard.down('w');
        await viewer.changed('a while of flying', before);
        await keyboard.up('w');
      },
    ],
  ];
  for (const [name, move] of moves) {
    const before = await viewer.settled();
    const { state } = viewer;
    await move(before);
    await viewer.stateWith(name, ({ eye }) => eye?.x !== state?.eye?.x || eye?.z !== state?.eye?.z);
    await viewer.changed(name, before);
  }
});

it('Orbit_SendsAtMostOneCameraForAnAnimationFrame', async () => {
  const viewer = await open();
  const { mouse } = viewer.page;
  await mouse.move(300, 300);
  await mouse.down();
  const frames = viewer.page.evaluate(
    () =>
      new Promise<number>((resolve) => {
        let count = 0;
        const tick = (): void => {
          count += 1;
          if (document.body.dataset.done === '1') resolve(count);
          else requestAnimationFrame(tick);
        };
        requestAnimationFrame(tick);
      }),
  );
  await mouse.move(600, 320, { steps: 200 });
  await viewer.page.evaluate(() => (document.body.dataset.done = '1'));
  await mouse.up();
  await viewer.settled();
  const cameras = viewer.sent.filter(({ body }) => body.case === 'setCamera').length;
  expect(cameras).toBeGreaterThan(0);
  expect(cameras).toBeLessThanOrEqual((await frames) + 1);
});

it('Link_ReproducesTheView', async () => {
  const first = await open();
  const { mouse } = first.page;
  await mouse.move(600, 300);
  await mouse.down();
  await mouse.move(680, 330, { steps: 5 });
  await mouse.up();
  await first.settled();
  const { state } = first;
  const far = (a = 0, b = 0): boolean => Math.abs(a - b) > 1e-9;
  await until('the link', () => {
    const { target, lightTime } = parseAddress(new URL(first.page.url()).hash).settings;
    return target && !far(target.x, state?.target?.x) && lightTime === state?.lightTimeS;
  });
  const second = await open(new URL(first.page.url()).hash);
  await second.stateWith('the same camera', ({ target }) => !far(target?.x, state?.target?.x));
  const before = await first.settled();
  // The camera is rebuilt from eye and target, so it may differ by a rounding.
  await until('the same picture', async () => difference(await second.settled(), before) < 0.1);
  expect(second.lastFrame?.timeS).toBe(first.lastFrame?.timeS);
});

it('Sessions_AreTheirViewersOwn', async () => {
  const [first, second] = [await open(), await open()];
  const before = await second.settled();
  await first.openPanel();
  await first.choose('renderer', 'toon fragment');
  await first.type('exposure', 4);
  await first.stateWith('exposure 4', ({ exposure }) => exposure === 4);
  expect(second.state?.exposure).toBe(1);
  expect(difference(await second.thumbnail(), before)).toBe(0);
});

it('Link_IsAStillToo', async () => {
  const viewer = await pages.open('#size=320x180&animate=0&light_time=3&lights=50&fog_density=0.01');
  await viewer.picture();
  await viewer.page.keyboard.press('ArrowLeft');
  await until('the link', () => new URL(viewer.page.url()).hash.includes('target='));
  const { origin, hash } = new URL(viewer.page.url());
  const answer = await fetch(`${origin}/render?${hash.slice(1)}`);
  expect(await (answer.ok ? answer.headers.get('content-type') : answer.text())).toBe('image/jpeg');
});

it('ScreenshotButton_SavesThePictureAsPng', async () => {
  const viewer = await open();
  await viewer.stateWith('320 × 180', ({ width }) => width === 320);
  await until('a small picture', () => viewer.page.evaluate(() => document.querySelector('canvas')?.width === 320));
  const [download] = await Promise.all([
    viewer.page.waitForEvent('download'),
    viewer.page.keyboard.press('p'),
  ]);
  expect(download.suggestedFilename()).toMatch(/^froxel-.*\.png$/);
  const png = readFileSync(await download.path());
  expect(png.subarray(1, 4).toString()).toBe('PNG');
  expect([png.readUInt32BE(16), png.readUInt32BE(20)]).toEqual([320, 180]);
});

it('Recording_SavesAScriptThatTheLoadToolPlays', async () => {
  const viewer = await open();
  const record = viewer.page.locator('#tool-record');
  expect(await record.isVisible()).toBe(false);
  await viewer.page.keyboard.press('x');
  expect(await record.isVisible()).toBe(true);
  await viewer.openPanel();
  await viewer.type('exposure', 4);
  await viewer.stateWith('exposure 4', ({ exposure }) => exposure === 4);
  const [download] = await Promise.all([viewer.page.waitForEvent('download'), record.click()]);
  expect(await record.isVisible()).toBe(false);
  expect(download.suggestedFilename()).toMatch(/^froxel-.*\.jsonl$/);
  const path = await download.path();
  const script = readFileSync(path, 'utf8');
  const lines = script.trimEnd().split('\n').map((line) => JSON.parse(line) as object);
  expect(lines[0]).toMatchObject({ at_ms: 0, setSize: { width: 320, height: 180 } });
  expect(lines.at(-1)).toMatchObject({ setExposure: { exposure: 4 } });
  const file = `${path}.jsonl`; // the tool tells scripts by their ending
  writeFileSync(file, script);
  const played = promisify(execFile)(process.env.FROXEL_BINARY ?? '', [
    'load', pages.url, '--viewers', '1', '--seconds', '2', '--script', file,
  ]);
  expect((await played).stderr).not.toContain('refused');
});

it('HiddenPage_PausesTheServerUntilItIsSeenAgain', async () => {
  const viewer = await open('#size=160x90&lights=50&animate=1');
  const hide = (hidden: boolean): Promise<void> =>
    viewer.page.evaluate((value) => {
      Object.defineProperty(document, 'hidden', { configurable: true, get: () => value });
      document.dispatchEvent(new Event('visibilitychange'));
    }, hidden);
  await hide(true);
  let last = -1;
  await until('no more frames for a second', async () => {
    last = viewer.frameCount;
    await viewer.page.waitForTimeout(1000);
    return viewer.frameCount === last;
  });
  await hide(false);
  await until('frames again', () => viewer.frameCount > last + 5);
});

it('Details_InTheFold_SayListsGridMemoryAndPlan', async () => {
  const viewer = await open('#size=640x360&animate=0&lights=1000&count_pairs=1&light_loop=lists');
  const { page } = viewer;
  expect(await page.locator('#detail-lists').isVisible()).toBe(false);
  await viewer.openFigures();
  await page.locator('#stats-details summary').click();
  const shows = (id: string, text: string): Promise<true> =>
    until(`${text} in #${id}`, async () =>
      ((await page.locator(`#${id}`).textContent()) ?? '').includes(text) ? true : null,
    );
  await shows('detail-lists', 'List entries');
  await shows('detail-lists', 'contributing');
  await shows('detail-grid', 'Grid, automatic');
  await shows('detail-memory', 'Together');
  expect(await page.locator('#detail-plan li').count()).toBeGreaterThan(0);
  expect(await page.locator('#detail-grid-why').textContent()).not.toBe('');
  await page.locator('#detail-plan').scrollIntoViewIfNeeded();
  await viewer.screenshot('details');
});

it('Lights_AMillion_AreWithinTheSlidersReach', async () => {
  // Small ones: a million that each light half the hall would take a CPU minutes.
  const viewer = await open('#size=160x90&animate=0&lights=50&light_radius=0.05');
  await viewer.openPanel();
  const slider = viewer.control('lights').locator('input[type=range]');
  await slider.press('End');
  await viewer.stateWith('a million lights', ({ lightCount }) => lightCount === 1_000_000);
  const box = viewer.control('lights').locator('input:not([type=range])');
  expect(await box.inputValue()).toBe('1000000');
  await slider.press('Home');
  await viewer.stateWith('none', ({ lightCount }) => lightCount === 0);
});

it('Help_OpensAndClosesByKey', async () => {
  const viewer = await open();
  await viewer.page.keyboard.press('?');
  expect(await viewer.page.locator('#help').isVisible()).toBe(true);
  expect(await viewer.page.locator('#about').textContent()).toContain('froxel');
  await viewer.screenshot('help');
  await viewer.page.keyboard.press('Escape');
  expect(await viewer.page.locator('#help').isVisible()).toBe(false);
});

it('Phone_At360Px_ShowsThePictureAndFoldsTheRest', async () => {
  const viewer = await open(kStill, {
    viewport: { width: 360, height: 740 },
    hasTouch: true,
    isMobile: true,
    deviceScaleFactor: 2,
    colorScheme: 'dark',
  });
  const { page } = viewer;
  await viewer.screenshot('phone');
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(width).toBe(360);
  expect(await viewer.control('lights').isVisible()).toBe(false);
  await viewer.openPanel();
  const control = viewer.control('lights');
  await control.scrollIntoViewIfNeeded();
  const box = await control.boundingBox();
  expect(box && box.x >= 0 && box.x + box.width <= 360).toBe(true);
  await viewer.screenshot('phone-panel');
  await viewer.control('grid.auto').scrollIntoViewIfNeeded();
  await viewer.screenshot('phone-clusters');
  await viewer.type('lights', 7);
  await viewer.stateWith('7 lights', ({ lightCount }) => lightCount === 7);
});

/** Share of the window that lies under what is not the picture. */
function covered(page: Page): Promise<number> {
  return page.evaluate(() => {
    const boxes = [...document.querySelectorAll('body > :not(canvas, dialog, script, #handles)')]
      .map((part) => part.getBoundingClientRect())
      .filter(({ width, height }) => width * height > 0);
    const area = boxes.reduce((sum, { width, height }) => sum + width * height, 0);
    return area / (innerWidth * innerHeight);
  });
}

it.each([
  [1280, 720, 0.08],
  [390, 844, 0.12],
  [320, 640, 0.15],
])('FirstLook_%ix%i_IsThePicture', async (width, height, most) => {
  const viewer = await open(kStill, { viewport: { width, height } });
  const { page } = viewer;
  await until('the scene and figures', async () => Number(await page.locator('#stat-fps').textContent()) >= 0);
  expect(await covered(page)).toBeLessThan(most);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(width);
  const tools = await page.locator('#tools').boundingBox();
  expect(tools && tools.x >= 0 && tools.x + tools.width <= width).toBe(true);
  await viewer.screenshot(`first-look-${width}`);
});

it('PanelAndFigures_AreAsTheyWereLeft', async () => {
  const viewer = await open();
  const { page } = viewer;
  expect(await page.locator('#panel').isVisible()).toBe(false);
  expect(await page.locator('#stats-body').isVisible()).toBe(false);
  await page.locator('#tool-panel').click();
  await page.keyboard.press('f'); // the picture kept the focus
  await viewer.screenshot('open');
  await page.reload();
  await viewer.picture();
  expect(await page.locator('#panel').isVisible()).toBe(true);
  expect(await page.locator('#stats-body').isVisible()).toBe(true);
  await page.keyboard.press('c');
  expect(await page.locator('#panel').isVisible()).toBe(false);
});

it('Tab_IsDuplicated_BothHaveTheirOwnView', async () => {
  const { page } = await open();
  const banner = '#banner';
  const [copy] = await Promise.all([
    page.context().waitForEvent('page'),
    page.evaluate(() => void window.open(location.href)), // with what the tab kept, as duplicates have it
  ]);
  const connected = (of: Page): Promise<unknown> =>
    until('a picture', () => of.evaluate(() => document.getElementById('progress')?.hidden === true));
  await connected(copy);
  expect(await copy.evaluate(() => sessionStorage.getItem('froxel.resume.'))).not.toBe(
    await page.evaluate(() => sessionStorage.getItem('froxel.resume.')),
  );
  expect(await page.locator(banner).isVisible()).toBe(false);
  expect(await copy.locator(banner).isVisible()).toBe(false);
});

it('HighContrast_WhatIsPressedLooksPressed_AndSlidersHaveATrack', async () => {
  const { page } = await open(kStill, { forcedColors: 'active' });
  await page.locator('#tool-panel').click();
  const groundOf = (id: string): Promise<string> =>
    page.locator(id).evaluate((tool) => getComputedStyle(tool).backgroundColor);
  expect(await groundOf('#tool-panel')).not.toBe(await groundOf('#tool-home'));
  // The browser would paint the track's ground away, and it has nothing else.
  const slider = page.locator('#panel input.slider').first();
  expect(await slider.evaluate((one) => getComputedStyle(one).forcedColorAdjust)).toBe('none');
  await page.screenshot({ path: 'test-results/high-contrast.png' });
});

it('Search_LeadsToASettingAndRunsAnAction', async () => {
  const viewer = await open();
  const { page } = viewer;
  await page.keyboard.press('Control+k');
  await page.keyboard.type('cluster grid law');
  await page.keyboard.press('Escape');
  expect(await page.locator('#search').isVisible()).toBe(false);
  await page.keyboard.press('Control+k');
  await page.keyboard.type('exposure');
  await viewer.screenshot('search');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowUp');
  await page.locator('#search-list li', { hasText: /^Exposure[^ ]/ }).first().click();
  expect(await viewer.control('exposure').isVisible()).toBe(true);
  expect(await page.evaluate(() => document.activeElement?.closest('[data-field]')?.getAttribute('data-field'))).toBe('exposure');
  await page.keyboard.press('c'); // not the picture's: nothing closes
  expect(await page.locator('#panel').isVisible()).toBe(true);
  await page.keyboard.press('Control+k');
  await page.keyboard.type('next renderer');
  const before = viewer.state?.renderer;
  await page.keyboard.press('Enter');
  await viewer.stateWith('another renderer', ({ renderer }) => renderer !== before);
});

it('PageThatOpensTiny_AsksForNothingUntilItIsSeen', async () => {
  const viewer = await open('#animate=0', { viewport: { width: 8, height: 8 } });
  const asked = (): number => viewer.sent.filter(({ body }) => body.case === 'setSize').length;
  expect(asked()).toBe(0);
  await viewer.page.setViewportSize({ width: 1280, height: 720 });
  // As many pixels as the server proposes, not all that the window has.
  await viewer.stateWith('the proposed size', ({ width }) => width >= 600 && width <= 640);
});
