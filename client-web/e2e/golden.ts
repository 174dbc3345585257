// Pictures of the page as they were when somebody looked at them, and how far another may be from them.

import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

import type { Page } from 'playwright-core';

import type { Viewer } from './viewer';

const kGolden = fileURLToPath(new URL('./golden', import.meta.url));
/** Both are compared at this part of their size: how text's edges are smoothed does not count. */
const kPart = 1 / 8;
/** Steps of 8 bits that any of the small pixels may be off. A word more or less is 40 and more. */
export const kTolerance = 20;

/** The largest difference of two PNGs' small copies; 255 where their sizes differ. Runs in a page. */
async function worst({ a, b, part }: { a: string; b: string; part: number }): Promise<number> {
  const small = async (png: string): Promise<ImageData> => {
    const image = new Image();
    image.src = `data:image/png;base64,${png}`;
    await image.decode();
    const width = Math.floor(image.width * part);
    const height = Math.floor(image.height * part);
    const context = new OffscreenCanvas(width, height).getContext('2d');
    if (!context) throw new Error('no 2D context');
    context.imageSmoothingQuality = 'high';
    context.drawImage(image, 0, 0, width, height);
    return context.getImageData(0, 0, width, height);
  };
  const [one, other] = [await small(a), await small(b)];
  if (one.width !== other.width || one.height !== other.height) return 255;
  return one.data.reduce((most, value, i) => Math.max(most, Math.abs(value - (other.data[i] ?? 0))), 0);
}

/** Takes the page's picture and gives its difference to the golden one; with UPDATE_GOLDEN=1 it becomes that. */
export async function offGolden(viewer: Viewer, blank: Page, name: string): Promise<number> {
  const taken = await viewer.screenshot(name);
  const golden = `${kGolden}/${name}.png`;
  if (process.env.UPDATE_GOLDEN === '1') {
    mkdirSync(kGolden, { recursive: true });
    writeFileSync(golden, taken);
    return 0;
  }
  if (!existsSync(golden)) throw new Error(`${golden} is missing; UPDATE_GOLDEN=1 writes it`);
  const [a, b] = [taken.toString('base64'), readFileSync(golden).toString('base64')];
  return blank.evaluate(worst, { a, b, part: kPart });
}
