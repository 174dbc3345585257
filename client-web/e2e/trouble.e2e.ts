// Bad input, and a server that goes away.

import type { Browser } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect, it } from 'vitest';

import { LightingStage, Renderer, type ViewState } from '../src/gen/froxel/v1/common_pb';
import { ErrorCode } from '../src/gen/froxel/v1/server_pb';
import { launch } from './chromium';
import { startServer, type Server } from './server';
import { until, Viewer } from './viewer';

const kStill = '#size=320x180&animate=0&lights=50';

let server: Server;
let browser: Browser;
let viewer: Viewer;

beforeAll(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
afterAll(async () => {
  await browser.close();
  expect(await server.stop()).toBe(0);
});
afterEach(() => viewer.close());

async function open(hash: string): Promise<void> {
  viewer = await Viewer.open(browser, server.url + hash);
  await viewer.picture();
}

it('ValueOutOfRange_ShowsTheServersWordsAndKeepsTheLastGoodState', async () => {
  await open(kStill);
  await viewer.openPanel();
  await viewer.stateWith('50 lights', ({ lightCount }) => lightCount === 50);
  await viewer.type('lights', 1e9);
  await viewer.told('lights');
  await viewer.screenshot('error');
  const input = viewer.control('lights').locator('input:not([type=range])');
  await until('the last good number', async () => (await input.inputValue()) === '50');
  await viewer.page.locator('#banner-remedy').click();
  expect(await viewer.page.locator('#banner').isVisible()).toBe(false);
  await viewer.type('lights', 60);
  await viewer.stateWith('60 lights', ({ lightCount }) => lightCount === 60);
  expect(viewer.connectionCount).toBe(1);
});

// lavapipe has no descriptor indexing, which the forward renderers' compute stage needs. On a
// device that has it, the setting is simply taken.
it('SettingThatTheDeviceCannotDo_ShowsWhyAndKeepsTheLastGoodState', async () => {
  await open(`${kStill}&renderer=forward_plus`);
  await viewer.openPanel();
  await viewer.settled();
  await viewer.choose('lighting', 'compute');
  await viewer.settled();
  const told = viewer.received.flatMap(({ body }) => (body.case === 'error' ? [body.value] : []));
  if (!told[0]) {
    expect(viewer.state?.lighting).toBe(LightingStage.COMPUTE);
    return;
  }
  expect(told[0].code).toBe(ErrorCode.UNSUPPORTED);
  expect(told[0].message).not.toBe('');
  await viewer.told(told[0].message);
  await viewer.stateWith('what it was', ({ lighting }) => lighting !== LightingStage.COMPUTE);
  const shown = viewer.control('lighting').locator('select');
  await until('the last good choice', async () => {
    return (await shown.locator('option:checked').textContent()) !== 'compute';
  });
  await viewer.type('lights', 60);
  await viewer.stateWith('60 lights', ({ lightCount }) => lightCount === 60);
  expect(viewer.connectionCount).toBe(1);
});

it('PartOfThePageThatCannotBeFetched_IsSaidWhenItIsWanted', async () => {
  viewer = await Viewer.open(browser, 'about:blank');
  await viewer.page.route(/panel-.*\.js/, (route) => route.abort());
  const tried = viewer.page.waitForEvent('requestfailed'); // fetched ahead, in vain
  await viewer.page.goto(server.url + kStill);
  await viewer.picture();
  await tried;
  expect(await viewer.page.locator('#banner').isVisible()).toBe(false);
  await viewer.page.locator('#tool-panel').click();
  await viewer.told('could not be fetched');
});

it('WordsThatComeWhileTheSearchIsOpen_AreShownInIt', async () => {
  viewer = await Viewer.open(browser, 'about:blank');
  let arrive = (): void => undefined;
  const wanted = new Promise<void>((resolve) => (arrive = resolve));
  await viewer.page.route(/settings\.json$/, async (route) => {
    await wanted;
    await route.continue();
  });
  await viewer.page.goto(server.url + kStill);
  await viewer.picture();
  await viewer.page.keyboard.press('Control+k');
  await viewer.page.locator('#search-text').fill('expo');
  const list = viewer.page.locator('#search-list');
  await until('a list without help', async () => (await list.textContent())?.includes('Exposure mode'));
  expect(await list.textContent()).not.toContain('Factor on scene light');
  arrive();
  await until('the help of it', async () => (await list.textContent())?.includes('Factor on scene light'));
});

it('NumberThatIsNoWholeOne_IsRefusedHere', async () => {
  await open(kStill);
  await viewer.openPanel();
  await viewer.type('seed', 1.5);
  await viewer.told('whole number');
  expect(viewer.sent.some(({ body }) => body.case === 'setLights' && body.value.seed === 1)).toBe(false);
});

it('LinkWithNonsense_IsNamedAndTheRestCounts', async () => {
  await open(`${kStill}&renderer=fastest`);
  await viewer.told('renderer=fastest');
  await viewer.stateWith('50 lights', ({ lightCount }) => lightCount === 50);
});

it('LinkOutOfRange_ShowsTheServersWords', async () => {
  await open('#size=320x180&animate=0&exposure=-1');
  await viewer.told('exposure');
  await viewer.stateWith('320 × 180', ({ width }) => width === 320);
});

it('ServerRestart_TheViewGoesOn', async () => {
  const restored = ({ renderer, lightCount }: ViewState): boolean =>
    renderer === Renderer.FORWARD_PLUS && lightCount === 123;
  await open(kStill);
  await viewer.openPanel();
  await viewer.type('lights', 123);
  await viewer.choose('renderer', 'forward plus');
  await viewer.stateWith('forward plus', restored);
  const before = viewer.received.length;
  const code = await server.stop();
  expect(code).toBe(0);
  await viewer.told(/Next try in/);
  await viewer.screenshot('reconnect');
  server = await startServer(server.port);
  const welcome = await until('Welcome', () =>
    viewer.received.slice(before).find(({ body }) => body.case === 'welcome'),
  );
  expect(welcome.body.case === 'welcome' && welcome.body.value.state?.lightCount).not.toBe(123);
  await viewer.stateWith('what it was', restored);
  const frames = viewer.frameCount;
  await until('new frames', () => viewer.frameCount > frames);
  await until('no banner', async () => !(await viewer.page.locator('#banner').isVisible()));
  await viewer.picture();
});

it('TryNow_ConnectsAtOnce', async () => {
  await open(kStill);
  // The page's clock stands: only the button can start the next try.
  await viewer.page.clock.install();
  await viewer.page.clock.pauseAt(Date.now() + 60_000);
  await server.stop();
  await viewer.told(/Next try in/);
  server = await startServer(server.port);
  expect(viewer.connectionCount).toBe(1);
  await viewer.page.locator('#banner-remedy').click();
  await until('no banner', async () => !(await viewer.page.locator('#banner').isVisible()));
  await until('the connection', () => viewer.connectionCount > 1);
  expect(viewer.connectionCount).toBe(2);
});
