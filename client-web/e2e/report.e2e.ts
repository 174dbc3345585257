// The reports of `froxel bench`, `load` and `diff` as a reader opens them: one file, no network.

import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

import type { AxeResults } from 'axe-core';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { kDiffSamplePath, kLoadSamplePath, kSamplePath, sample } from '../test/report/fakes';
import { launch } from './chromium';
import { until } from './viewer';

const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const kTemplate = fileURLToPath(new URL('../dist/report.html', import.meta.url));
const kLoadTemplate = fileURLToPath(new URL('../dist/load.html', import.meta.url));
const kDiffTemplate = fileURLToPath(new URL('../dist/diff.html', import.meta.url));
const kPlace = '<script type="application/json" id="results">null</script>';

let browser: Browser;
let folder: string;
let filled: string;
let loadFilled: string;
let diffFilled: string;

/** A template of dist/ with the JSON of a run in it. */
function fill(name: string, template: string, path: string): string {
  const file = join(folder, name);
  const parts = readFileSync(template, 'utf8').split(kPlace);
  expect(parts).toHaveLength(2);
  const results = readFileSync(path, 'utf8').replaceAll('<', '\\u003c');
  writeFileSync(file, parts.join(kPlace.replace('null', () => results)));
  return file;
}

beforeAll(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'froxel-report-'));
  filled = fill('report.html', kTemplate, kSamplePath);
  loadFilled = fill('load.html', kLoadTemplate, kLoadSamplePath);
  diffFilled = fill('diff.html', kDiffTemplate, kDiffSamplePath);
});
afterAll(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

interface Opened {
  readonly page: Page;
  readonly complaints: string[];
  readonly fetched: string[];
}

async function open(file: string, width: number, colorScheme: 'light' | 'dark'): Promise<Opened> {
  const context = await browser.newContext({
    viewport: { width, height: 800 },
    colorScheme,
    offline: true,
  });
  const page = await context.newPage();
  const complaints: string[] = [];
  const fetched: string[] = [];
  page.on(
    'console',
    (message) => void (message.type() === 'error' && complaints.push(message.text())),
  );
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on(
    'request',
    (request) => void (!request.url().startsWith('data:') && fetched.push(request.url())),
  );
  await page.goto(pathToFileURL(file).href);
  return { page, complaints, fetched };
}

/** The elements whose text is too faint, and how many are not. */
async function contrasts(page: Page): Promise<{ poor: string[]; good: number }> {
  await page.evaluate(kAxe);
  const found = await page.evaluate(() =>
    (globalThis as unknown as { axe: { run(at: Document, how: object): Promise<AxeResults> } }).axe.run(document, {
      runOnly: ['color-contrast'],
    }),
  );
  return {
    poor: found.violations.flatMap(({ nodes }) => nodes.map(({ html, failureSummary }) => `${html} ${failureSummary ?? ''}`)),
    good: found.passes.flatMap(({ nodes }) => nodes).length,
  };
}

/** Pairs of texts of one plot whose boxes overlap by more than a pixel. */
const overlaps = (page: Page): Promise<string[]> =>
  page.evaluate(() =>
    [...document.querySelectorAll('.plot svg')].flatMap((svg) => {
      const texts = [...svg.querySelectorAll('text')].filter(
        ({ textContent }) => textContent !== '',
      );
      const boxes = texts.map((text) => text.getBoundingClientRect());
      return boxes.flatMap((a, i) =>
        boxes.slice(i + 1).flatMap((b, j) => {
          const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
          const along = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
          return across > 1 && along > 4
            ? [
                `"${String(texts[i]?.textContent)}" on "${String(texts[i + j + 1]?.textContent)}" in ${String(svg.closest('section')?.id)}`,
              ]
            : [];
        }),
      );
    }),
  );

describe('report', () => {
  it.each([
    [1240, 'light'],
    [390, 'dark'],
  ] as const)('FromAFile_%dPixels_%s_ShowsEverySweepWithoutNetwork', async (width, scheme) => {
    const { page, complaints, fetched } = await open(filled, width, scheme);
    const { sweeps } = sample();
    await until('the plots', async () => (await page.locator('.plot svg').count()) > sweeps.length);
    for (const { name, rows } of sweeps) {
      const section = page.locator(`#sweep-${name}`);
      expect(await section.locator('.plot svg').count(), name).toBeGreaterThan(0);
      expect(await section.locator('.table').first().locator('tbody tr').count(), name).toBe(
        rows.length,
      );
    }
    expect(await page.locator('#speed-against-error .plot svg').count()).toBe(2);
    expect(await overlaps(page)).toEqual([]);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(width);
    expect(complaints).toEqual([]);
    expect(fetched).toEqual([pathToFileURL(filled).href]);
    await page.context().close();
  });

  it.each(['light', 'dark'] as const)('EveryText_HasItsContrast_%s', async (scheme) => {
    const { page } = await open(filled, 1240, scheme);
    await until('the plots', async () => (await page.locator('.plot svg').count()) > 1);
    await page.evaluate(() => document.querySelectorAll('details').forEach((fold) => (fold.open = true)));
    const found = await contrasts(page);
    expect(found.poor).toEqual([]);
    expect(found.good).toBeGreaterThan(50);
    await page.context().close();
  });

  it('FiguresOfOthers_AreLast_AndFolded', async () => {
    const { page } = await open(filled, 1240, 'light');
    await until('the sections', async () => (await page.locator('#published').count()) > 0);
    expect(await page.locator('#report > section').last().getAttribute('id')).toBe('published');
    expect(await page.locator('#published table').first().isVisible()).toBe(false);
    await page.context().close();
  });

  it('ColourScheme_ChangesThePage', async () => {
    const paper = async (scheme: 'light' | 'dark'): Promise<string> => {
      const { page } = await open(filled, 800, scheme);
      const colour = await page.evaluate(
        () => getComputedStyle(document.documentElement).backgroundColor,
      );
      await page.context().close();
      return colour;
    };
    expect(await paper('light')).not.toBe(await paper('dark'));
  });

  it('Clock_ChangesTimesInPlotAndTable', async () => {
    const { page } = await open(filled, 1240, 'light');
    const shown = (): Promise<string> => page.locator('#sweep-light_count').innerText();
    const before = await until(
      'a table',
      async () => (await page.locator('#sweep-light_count td').count()) > 0 && shown(),
    );
    await page.locator('.picker select').selectOption('gpu_us');
    await until('other times', async () => (await shown()) !== before);
    expect(await page.locator('#sweep-light_count .plot').first().innerText()).toContain(
      'GPU time',
    );
    await page.context().close();
  });

  it('CopyButton_CopiesTheRowsCommand', async () => {
    const { page } = await open(filled, 1240, 'light');
    await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    await page.locator('#sweep-light_count button.copy').first().click();
    await until(
      'the word',
      async () => (await page.locator('button.copy', { hasText: 'copied' }).count()) > 0,
    );
    const copied = await page.evaluate(() => navigator.clipboard.readText());
    const counted = sample().sweeps.find(({ name }) => name === 'light_count');
    expect(copied).toBe(counted?.rows[0]?.command);
    await page.context().close();
  });

  it('EmptyTemplate_SaysWhoFillsIt', async () => {
    const { page } = await open(kTemplate, 800, 'light');
    expect(await page.locator('#report').innerText()).toContain('froxel bench --report');
    await page.context().close();
  });

  it.each([
    [1240, 'light'],
    [390, 'dark'],
  ] as const)('LoadTest_%dPixels_%s_ShowsVerdictPlotsAndViewers', async (width, scheme) => {
    const { page, complaints, fetched } = await open(loadFilled, width, scheme);
    await until('the plots', async () => (await page.locator('.plot svg').count()) === 5);
    expect(await page.locator('#head .warning').innerText()).toContain('broken requirement fps>=8: ');
    expect(await page.locator('#requirements tbody tr').count()).toBe(4);
    expect(await page.locator('#requirements td.bad').allInnerTexts()).toEqual(['broken']);
    expect(await page.locator('#viewers tbody tr').count()).toBe(8);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(width);
    expect(await overlaps(page)).toEqual([]);
    expect(complaints).toEqual([]);
    expect(fetched).toEqual([pathToFileURL(loadFilled).href]);
    await page.context().close();
  });

  it('LoadTemplate_Empty_SaysWhoFillsIt', async () => {
    const { page } = await open(kLoadTemplate, 800, 'light');
    expect(await page.locator('#report').innerText()).toContain('froxel load --report');
    await page.context().close();
  });

  it.each([
    [1280, 'light'],
    [390, 'dark'],
  ] as const)('Diff_%dPixels_%s_ShowsPairsSideBySide', async (width, scheme) => {
    const { page, complaints, fetched } = await open(diffFilled, width, scheme);
    expect(await page.locator('#pairs tbody tr').count()).toBe(3);
    expect(await page.locator('#pairs td.bad').allInnerTexts()).toEqual(['failed', 'failed']);
    const pair = page.locator('.pair');
    expect(await pair.count()).toBe(1);
    const divider = page.getByRole('slider');
    await divider.focus();
    await divider.press('Home');
    expect(await pair.evaluate((frame) => frame.style.getPropertyValue('--at'))).toBe('0%');
    await divider.press('End');
    expect(await pair.evaluate((frame) => frame.style.getPropertyValue('--at'))).toBe('100%');
    await page.getByRole('checkbox', { name: 'heat map of FLIP' }).check();
    expect(await page.getByRole('img', { name: 'nave.png: heat map of FLIP' }).isVisible()).toBe(true);
    expect(await page.getByRole('img', { name: 'nave.png: the picture' }).isVisible()).toBe(false);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(width);
    expect(complaints).toEqual([]);
    expect(fetched).toEqual([pathToFileURL(diffFilled).href]);
    expect((await contrasts(page)).poor).toEqual([]);
    await page.context().close();
  });
});
