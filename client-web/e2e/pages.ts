// A server and a browser for the tests of a file, and the pages that each test opens.

import type { Browser, BrowserContextOptions } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect } from 'vitest';

import { launch } from './chromium';
import { startServer, type Server } from './server';
import { Viewer } from './viewer';

export interface Pages {
  readonly url: string;
  /** See Server. */
  hold(held: boolean): void;
  /** `at`: what follows the server's address. Resolves once a picture is there. */
  open(at: string, options?: BrowserContextOptions): Promise<Viewer>;
}

/** After each test its pages are closed, and none may have complained. `options`: of the server. */
export function usePages(options: readonly string[] = []): Pages {
  let server: Server;
  let browser: Browser;
  let viewers: Viewer[] = [];

  beforeAll(async () => {
    [server, browser] = await Promise.all([startServer(0, options), launch()]);
  });
  afterAll(async () => {
    await browser.close();
    expect(await server.stop()).toBe(0);
  });
  afterEach(async () => {
    const complaints = viewers.flatMap((viewer) => viewer.complaints);
    await Promise.all(viewers.map((viewer) => viewer.close()));
    viewers = [];
    expect(complaints).toEqual([]);
  });

  return {
    get url() {
      return server.url;
    },
    hold: (held) => server.hold(held),
    async open(at, context = {}) {
      const viewer = await Viewer.open(browser, server.url + at, context);
      viewers.push(viewer);
      await viewer.picture();
      return viewer;
    },
  };
}
