// Input to picture in headless Chromium, by the page's own clock: prints a line of JSON.

import { it } from 'vitest';

import { launch } from './chromium';
import { startServer } from './server';
import { until, Viewer } from './viewer';

const kWarmUpMs = 5_000;
const kDragMs = 30_000;
const kStepMs = 16; // between moves of the mouse

it('Latency_OfADraggedCamera', async () => {
  const server = await startServer();
  const browser = await launch();
  try {
    const viewer = await Viewer.open(browser, server.url);
    await until('frames', () => viewer.frameCount > 10);
    const { mouse } = viewer.page;
    await viewer.openFigures();
    await mouse.move(600, 360);
    await mouse.down();
    const begin = Date.now();
    let framesBefore = 0;
    let step = 0;
    while (Date.now() < begin + kWarmUpMs + kDragMs) {
      if (framesBefore === 0 && Date.now() > begin + kWarmUpMs) framesBefore = viewer.frameCount;
      step += 1;
      await mouse.move(600 + 200 * Math.sin(step / 40), 360);
      await viewer.page.waitForTimeout(kStepMs);
    }
    const frames = viewer.frameCount - framesBefore;
    const texts = (selector: string): Promise<string[]> =>
      viewer.page.locator(selector).allInnerTexts();
    const [latency] = await texts('#stats-list dt.latency + dd');
    const figures = {
      picture: `${String(viewer.lastFrame?.width)}x${String(viewer.lastFrame?.height)}`,
      framesPerSecond: Math.round((frames * 10_000) / kDragMs) / 10,
      latencyP50P95: latency,
      stages: (await texts('#stats-stages li')).map((text) => text.replaceAll('\n', ' ')),
    };
    await mouse.up();
    console.log(JSON.stringify(figures));
  } finally {
    await browser.close();
    await server.stop();
  }
});
