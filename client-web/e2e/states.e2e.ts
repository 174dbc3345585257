// Every state that the page can be in, at three sizes: its words, its picture, and that anybody can use it.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

import type { AxeResults } from 'axe-core';
import type { Browser, Page, WebSocketRoute } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, expect, it } from 'vitest';

import { serverMessage, serverMessageBytes } from '../test/fakes';
import { launch } from './chromium';
import { kTolerance, offGolden } from './golden';
import { startServer, type Server } from './server';
import { until, Viewer } from './viewer';

const kSizes = [
  { width: 1280, height: 720 },
  { width: 390, height: 844 },
  { width: 320, height: 568 },
];
const kStill = '#size=320x180&animate=0&lights=50';
const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const kRules = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];

/** The picture and what changes by the moment are not part of the goldens; one font is, which fontconfig brings along. */
const kSteady = `
  :root { --font: 'DejaVu Sans'; }
  #view { visibility: hidden; }
  #looks-list img { opacity: 0; }
  html, body { background: #56606e; }
  * { caret-color: transparent !important; transition: none !important; scrollbar-width: none !important; }
  #banner-aside, #about, #hint { display: none; }
  #stats-head .moving { display: inline !important; }
  #stats-head b { width: 3ch; visibility: hidden; }
  #stats-list dd, #passes-bar, #graph, #passes-table td, #stats-stages { visibility: hidden; font-size: 0; }
  progress { visibility: hidden; }
  /* A picture of many samples, which a quick machine goes on to, has passes for its surfaces before these. */
  #passes-table tr:not(:nth-last-child(-n + 4)) { display: none; }
`;

let server: Server;
let browser: Browser;
let blank: Page; // in which pictures are compared
let viewer: Viewer;
/** What happens to the page's next socket. */
let socket: (route: WebSocketRoute) => void;
let route: WebSocketRoute | null; // the newest one's page side
let silent: boolean; // whether the server's messages are held back

beforeAll(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
  blank = await browser.newPage();
});
afterAll(async () => {
  await browser.close();
  expect(await server.stop()).toBe(0);
});
beforeEach(() => {
  silent = false;
  route = null;
  socket = (page) => {
    const upstream = page.connectToServer();
    upstream.onMessage((message) => {
      if (!silent) page.send(message);
    });
  };
});
afterEach(() => viewer.close());

async function open(): Promise<void> {
  viewer = await Viewer.open(browser, 'about:blank');
  await viewer.page.routeWebSocket(/\/ws/, (page) => {
    route = page;
    socket(page);
  });
  await viewer.page.goto(server.url + '?reprojection=off' + kStill);
}

async function openWithPicture(): Promise<void> {
  await open();
  await viewer.picture();
}

/** From now on the page tries nothing again: it stays in the state that it comes to. */
const stay = (): Promise<void> =>
  viewer.page.evaluate(() => {
    const shortly = globalThis.setTimeout;
    globalThis.setTimeout = ((action: () => void, delayMs = 0) =>
      delayMs < 300 ? shortly(action, delayMs) : 0) as typeof setTimeout;
  });

const say = (body: Parameters<typeof serverMessage>[0]): void =>
  route?.send(Buffer.from(serverMessageBytes(serverMessage(body))));

const dimmed = (): Promise<boolean> =>
  viewer.page.evaluate(() => document.querySelector('#view')?.classList.contains('stale') ?? false);

/** Whether an element lies outside of what its list shows of itself: others like it are measured. */
const scrolledOut = (target: string): Promise<boolean> =>
  viewer.page.evaluate((selector) => {
    const element = document.querySelector(selector);
    const list = element?.closest('#looks-list')?.getBoundingClientRect();
    const own = element?.getBoundingClientRect();
    return list !== undefined && own !== undefined && (own.bottom > list.bottom || own.top < list.top);
  }, target);

/** What keeps somebody from using the page, over a picture all of that colour. */
async function findings(background: string, rules?: string[]): Promise<string[]> {
  const style = await viewer.page.addStyleTag({ content: `html, body { background: ${background} !important; }` });
  const run = rules ? { type: 'rule' as const, values: rules } : { type: 'tag' as const, values: kRules };
  const results = await viewer.page.evaluate(
    (options) => (globalThis as unknown as { axe: { run(options: object): Promise<AxeResults> } }).axe.run(options),
    { runOnly: run },
  );
  await style.evaluate((element) => (element as Element).remove());
  // Where axe cannot tell the contrast, nobody has measured it.
  const unsure = results.incomplete.filter(({ id }) => id === 'color-contrast');
  for (const result of unsure) {
    const out = await Promise.all(result.nodes.map(({ target }) => scrolledOut(target.join(' '))));
    result.nodes = result.nodes.filter((_, index) => !out[index]);
  }
  return [...results.violations, ...unsure].flatMap(({ id, nodes }) =>
    nodes.map(({ target, any }) => `${id} of ${target.join(' ')}: ${any[0]?.message ?? ''}`),
  );
}

async function looksAsItShould(name: string): Promise<void> {
  await viewer.page.addStyleTag({ content: kSteady });
  await viewer.page.evaluate(kAxe);
  for (const { width, height } of kSizes) {
    await viewer.page.setViewportSize({ width, height });
    await viewer.page.evaluate(() => new Promise((done) => setTimeout(done, 0)));
    // A busy machine's page may say for a moment that the view is slow.
    await until(`${name} at ${width} × ${height} as its golden picture has it`, async () => {
      return (await offGolden(viewer, blank, `${name}_${width}`)) <= kTolerance;
    });
    await isUsable(`${name} at ${width} × ${height}`);
  }
}

/** By everybody, over a picture of any brightness. */
async function isUsable(name: string): Promise<void> {
  expect.soft(await findings('#000'), name).toEqual([]);
  expect.soft(await findings('#fff', ['color-contrast']), `${name} over white`).toEqual([]);
}

it('Connecting', async () => {
  socket = () => undefined; // open, and without a word
  await open();
  await until('the words', () => viewer.page.locator('#progress').isVisible());
  expect(await viewer.page.locator('#progress-text').textContent()).toBe('Connecting…');
  // All that a first picture needs is there.
  await until('the worker', () =>
    viewer.page.evaluate(() =>
      performance.getEntriesByType('resource').some(({ name }) => name.includes('decode_worker')),
    ),
  );
  expect(await viewer.fetchedBytes()).toBeLessThan(64_500);
  await looksAsItShould('connecting');
});

it('Loading', async () => {
  socket = (page) => {
    page.onMessage(() => say({ case: 'loading', value: { stage: 'reading the scene', fraction: 0.42 } }));
  };
  await open();
  await until('how far it is', async () => {
    return (await viewer.page.locator('#progress-text').textContent()) === 'Reading the scene, 42 %';
  });
  await looksAsItShould('loading');
});

it('Full_BeforeTheFirstPicture', async () => {
  socket = (page) => {
    page.onMessage(() => void stay().then(() => page.close({ code: 4029 })));
  };
  await open();
  await viewer.told('All places on this server are in use. One becomes free when a viewer leaves.');
  await looksAsItShould('full');
});

it('Token', async () => {
  socket = (page) => {
    page.onMessage(() => void page.close({ code: 4003 }));
  };
  await open();
  await until('the question', () => viewer.page.locator('#token').isVisible());
  await looksAsItShould('token');
});

it('View', async () => {
  await openWithPicture();
  expect(await dimmed()).toBe(false);
  await looksAsItShould('view');
});

it('Settings', async () => {
  await openWithPicture();
  await viewer.page.locator('#tool-panel').click();
  await until('words', async () => (await viewer.page.locator('#panel [data-field]').count()) > 20);
  await looksAsItShould('settings');
});

it('Figures', async () => {
  await openWithPicture();
  await viewer.openFigures();
  await viewer.page.locator('#panel [data-field]').first().waitFor({ state: 'attached' }); // fetched ahead
  expect(await viewer.fetchedBytes()).toBeLessThan(126_000);
  await until('passes', async () => (await viewer.page.locator('#passes-table tr').count()) > 0);
  await looksAsItShould('figures');
});

it('Search', async () => {
  await openWithPicture();
  await viewer.page.keyboard.press('Control+k');
  await viewer.page.locator('#search-text').fill('expo');
  await looksAsItShould('search');
});

it('Looks', async () => {
  await openWithPicture();
  await viewer.page.locator('#tool-looks').click();
  await until('a picture', () =>
    viewer.page.evaluate(() => {
      const pictures = [...document.querySelectorAll<HTMLImageElement>('#looks-list img')];
      return pictures.some(({ naturalWidth }) => naturalWidth > 0);
    }),
  );
  await looksAsItShould('looks');
});

it('Help', async () => {
  await openWithPicture();
  await viewer.page.locator('#tool-help').click();
  await looksAsItShould('help');
});

it('CameraPath', async () => {
  await openWithPicture();
  await viewer.page.locator('#view').press('y');
  for (let key = 1; key <= 2; key += 1) {
    await viewer.page.locator('#path-add').click();
    await until('a key', async () => (await viewer.page.locator('.path-key').count()) === key);
  }
  await looksAsItShould('path');
});

it('Comparison', async () => {
  await openWithPicture();
  await viewer.page.evaluate(() => (location.hash += '&compare=exposure:8'));
  await until('figures', async () => (await viewer.page.locator('#compare-difference').textContent())?.includes('pixels differ'));
  // The line is behind the figures, which axe cannot tell.
  await viewer.page.addStyleTag({ content: `${kSteady} #compare-line { display: none; }` });
  await viewer.page.evaluate(kAxe);
  for (const size of kSizes) {
    await viewer.page.setViewportSize(size);
    await viewer.screenshot(`comparison_${size.width}`);
    await isUsable(`a comparison at ${size.width} × ${size.height}`);
  }
});

it('Lost_DimsTheLastPicture', async () => {
  await openWithPicture();
  await stay();
  await route?.close({ code: 1001 });
  await viewer.told('No connection to the server.');
  expect(await dimmed()).toBe(true);
  await looksAsItShould('lost');
});

it('DeviceLost', async () => {
  await openWithPicture();
  await stay();
  await route?.close({ code: 4050 });
  await viewer.told('The server lost its graphics device.');
  expect(await dimmed()).toBe(true);
  await looksAsItShould('device_lost');
});

it('Draining', async () => {
  await openWithPicture();
  await stay();
  say({ case: 'draining', value: { deadlineMs: 60_000 } });
  await viewer.told('The server is shutting down.');
  expect(await dimmed()).toBe(false);
  await looksAsItShould('draining');
});

it('AnotherVersion_AsksForAReload', async () => {
  await openWithPicture();
  await route?.close({ code: 4001 });
  await viewer.told('different versions');
  await looksAsItShould('another_version');
});

it('Refused_Setting', async () => {
  await openWithPicture();
  say({ case: 'error', value: { refSeq: 1n, field: 'exposure', message: 'exposure is -1; expected 0.001 to 1000' } });
  await viewer.told('exposure is -1');
  expect(await dimmed()).toBe(false);
  await looksAsItShould('refused');
});

it('Slow', async () => {
  await openWithPicture();
  silent = true;
  await viewer.page.locator('#view').press('ArrowLeft');
  await viewer.told('This view is slow to draw.');
  await looksAsItShould('slow');
});
