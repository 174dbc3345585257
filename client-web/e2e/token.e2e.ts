// A server that asks for a token.

import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import type { Browser } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect, it } from 'vitest';

import { launch } from './chromium';
import { startServer, type Server } from './server';
import { until, Viewer } from './viewer';

const kToken = 'the-right-token-0123456789';
const kWrong = 'another-token-0123456789';
const kStill = '#size=320x180&animate=0&lights=50';

const folder = mkdtempSync(join(tmpdir(), 'froxel-'));
let server: Server;
let browser: Browser;
let viewer: Viewer;

beforeAll(async () => {
  const file = join(folder, 'tokens');
  writeFileSync(file, `${kToken}\n`);
  [server, browser] = await Promise.all([startServer(0, ['--token-file', file]), launch()]);
});
afterAll(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
  expect(await server.stop()).toBe(0);
});
afterEach(() => viewer.close());

const asked = (): Promise<boolean> => viewer.page.locator('#token').isVisible();
const said = (): Promise<string> => viewer.page.locator('#token-said').innerText();

async function enter(token: string): Promise<void> {
  await until('the question', asked);
  await viewer.page.locator('#token-input').fill(token);
  await viewer.page.locator('#token button').click();
}

it('WrongTokenThenTheRightOne_OneLineThenTheView', async () => {
  viewer = await Viewer.open(browser, 'about:blank');
  const urls: string[] = [];
  viewer.page.on('request', (request) => urls.push(request.url()));
  viewer.page.on('websocket', (socket) => urls.push(socket.url()));
  await viewer.page.goto(server.url + kStill);
  await until('the question', asked);
  expect(await said()).toBe(''); // nothing was wrong yet

  await enter(kWrong);
  await until('why not', async () => (await asked()) && (await said()) !== '');
  expect(await said()).toBe('The server does not know this token.');
  await viewer.screenshot('token');
  expect(viewer.frameCount).toBe(0);

  await enter(kToken);
  await viewer.picture();
  expect(await asked()).toBe(false);
  await until('no banner', async () => !(await viewer.page.locator('#banner').isVisible()));
  await viewer.stateWith('50 lights', ({ lightCount }) => lightCount === 50);
  expect(viewer.connectionCount).toBe(3);

  // It outlives a reload, in this tab alone.
  const frames = viewer.frameCount;
  await viewer.page.reload();
  await until('new frames', () => viewer.frameCount > frames);
  expect(await asked()).toBe(false);
  const elsewhere = await viewer.page.evaluate(() => JSON.stringify([localStorage, document.cookie]));
  urls.push(viewer.page.url(), elsewhere);
  expect(urls.filter((url) => url.includes('token-0123456789'))).toEqual([]);
  expect(viewer.complaints).toEqual([]);
});
