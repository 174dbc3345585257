// From a move of the mouse to the first picture that shows it, over links of several delays: of the page's own warp, and
// of the server's picture. Prints a line of JSON for each.
// Needs cmake --build build/test --target froxel_relay.
//   FROXEL_SCENE   a scene file; without it the built-in hall

import type { Browser } from 'playwright-core';
import { it } from 'vitest';

import { launch } from './chromium';
import { startRelay, type LinkOptions } from './relay';
import { startServer } from './server';
import { until, Viewer } from './viewer';

const kWarmUpMs = 4_000;
const kDragMs = 15_000;
const kStepMs = 16;
const kLinks: readonly LinkOptions[] = [
  { delayMs: 0, kbitPerS: 0 },
  { delayMs: 25, kbitPerS: 0 },
  { delayMs: 75, kbitPerS: 0 },
  { delayMs: 25, kbitPerS: 2_500 },
];

interface Times {
  cameraTimes?: number[];
}

/** Runs in the page, before its own scripts: notes how long after a move of the mouse a warp of it was drawn. */
function noteWarps(): void {
  const times: number[] = [];
  (globalThis as Times).cameraTimes = times;
  let since: number | null = null; // the oldest move that was not drawn
  addEventListener('pointermove', (event) => void (since ??= event.buttons > 0 ? event.timeStamp : null), true);
  const context = WebGL2RenderingContext.prototype;
  // eslint-disable-next-line @typescript-eslint/unbound-method
  const draw = context.drawElements;
  context.drawElements = function (...args) {
    draw.apply(this, args);
    const from = since;
    since = null;
    const sync = from === null ? null : this.fenceSync(this.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (from === null || !sync) return;
    this.flush();
    const poll = (): void => {
      if (this.clientWaitSync(sync, 0, 0) === this.TIMEOUT_EXPIRED) setTimeout(poll, 1);
      else times.push(performance.now() - from);
    };
    setTimeout(poll, 1);
  };
}

const percentile = (sorted: readonly number[], share: number): number | null => {
  const value = sorted[Math.min(sorted.length - 1, Math.floor(sorted.length * share))];
  return value === undefined ? null : Math.round(value * 10) / 10;
};

async function measure(browser: Browser, url: string): Promise<object> {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
  await context.addInitScript(noteWarps);
  const viewer = await Viewer.in(context, url);
  try {
    await until('frames', () => viewer.frameCount > 2);
    const { mouse } = viewer.page;
    await viewer.openFigures();
    await mouse.move(600, 360);
    await mouse.down();
    const begin = Date.now();
    let frames = 0;
    for (let step = 1; Date.now() < begin + kWarmUpMs + kDragMs; step += 1) {
      if (frames === 0 && Date.now() > begin + kWarmUpMs) {
        frames = viewer.frameCount;
        await viewer.page.evaluate(() => void ((globalThis as Times).cameraTimes ?? []).splice(0));
      }
      await mouse.move(600 + 200 * Math.sin(step / 40), 360);
      await viewer.page.waitForTimeout(kStepMs);
    }
    const warps = await viewer.page.evaluate(() => (globalThis as Times).cameraTimes ?? []);
    const [server] = await viewer.page.locator('#stats-list dt.latency + dd').allInnerTexts();
    warps.sort((a, b) => a - b);
    const perSecond = (count: number): number => Math.round((count * 10_000) / kDragMs) / 10;
    return {
      picturesPerSecond: perSecond(viewer.frameCount - frames),
      serverP50P95: server,
      warpsPerSecond: perSecond(warps.length),
      warpP50: percentile(warps, 0.5),
      warpP95: percentile(warps, 0.95),
    };
  } finally {
    await viewer.close();
  }
}

it('Camera_OverLinks', async () => {
  const scene = process.env.FROXEL_SCENE;
  const server = await startServer(0, scene ? ['--scene', scene] : []);
  const browser = await launch();
  try {
    for (const link of kLinks) {
      const relay = await startRelay(server.port, link);
      for (const search of ['', '?reprojection=off']) {
        const figures = await measure(browser, `http://127.0.0.1:${relay.port}/${search}#size=640x360`);
        console.log(JSON.stringify({ ...link, search, ...figures }));
      }
      relay.close();
    }
  } finally {
    await browser.close();
    await server.stop();
  }
});
