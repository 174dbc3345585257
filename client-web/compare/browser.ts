// three.js in headless Chromium, without network: what its page asks for are files of this machine.

import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

import type { Browser } from 'playwright-core';
import { build } from 'vite';

import { launch } from '../e2e/chromium';
import type * as Drawing from './drawing';

const kFolder = fileURLToPath(new URL('.', import.meta.url));
const kDecoders = join(kFolder, '../node_modules/three/examples/jsm/libs');
const kSite = 'http://three.test'; // answered here

/** drawing.ts and all of three.js that it needs, as a script that sets `drawing`. */
async function bundle(): Promise<string> {
  const built = await build({
    configFile: false,
    logLevel: 'warn',
    build: { write: false, lib: { entry: join(kFolder, 'drawing.ts'), formats: ['iife'], name: 'drawing' } },
  });
  const [first] = Array.isArray(built) ? built : [];
  const code = first?.output[0].code;
  if (code === undefined) throw new Error('vite built no script');
  return code;
}

type Paths = Readonly<Record<string, string>>; // folders by the first part of their URLs

function fileOf(folders: Paths, path: string): string {
  const [, kind = '', ...rest] = decodeURIComponent(path).split('/');
  return join(folders[kind] ?? kDecoders, ...rest);
}

const urlOf = (kind: string, file: string): string => `${kSite}/${kind}/${encodeURIComponent(basename(file))}`;

export class ThreeJs {
  private constructor(
    private readonly browser: Browser,
    private readonly script: string,
  ) {}

  static async open(): Promise<ThreeJs> {
    const [browser, script] = await Promise.all([
      launch(['--use-angle=swiftshader', '--enable-unsafe-swiftshader']),
      bundle(),
    ]);
    return new ThreeJs(browser, script);
  }

  /** A PNG file; `environment` is a file, too. Rejects where three.js cannot read the scene. */
  async draw(scene: string, task: Omit<Drawing.Task, 'url' | 'decoders'>): Promise<Buffer> {
    const { environment } = task;
    const folders: Paths = {
      scene: dirname(scene),
      ...(environment !== null && { environment: dirname(environment) }),
    };
    const page = await this.browser.newPage();
    try {
      page.on('console', (message) => void (message.type() === 'error' && console.error(message.text())));
      await page.route(`${kSite}/**`, (route) => {
        const { pathname } = new URL(route.request().url());
        return pathname === '/'
          ? route.fulfill({ contentType: 'text/html', body: '<!doctype html>' })
          : route.fulfill({ path: fileOf(folders, pathname) });
      });
      await page.goto(kSite);
      await page.addScriptTag({ content: this.script });
      const url = await page.evaluate(
        (whole) => (globalThis as unknown as { drawing: typeof Drawing }).drawing.draw(whole),
        {
          ...task,
          url: urlOf('scene', scene),
          environment: environment && urlOf('environment', environment),
          decoders: `${kSite}/decoders`,
        },
      );
      return Buffer.from(url.slice(url.indexOf(',') + 1), 'base64');
    } finally {
      await page.close();
    }
  }

  close(): Promise<void> {
    return this.browser.close();
  }
}
