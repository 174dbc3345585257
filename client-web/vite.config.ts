import { createReadStream, createWriteStream } from 'node:fs';
import { join } from 'node:path';
import { pipeline } from 'node:stream/promises';
import { constants, createBrotliCompress, createGzip } from 'node:zlib';

import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';

/** Beside each file of the page its Brotli and its gzip: the server sends what a browser understands. */
const compressed: Plugin = {
  name: 'compressed',
  apply: 'build',
  async writeBundle({ dir = '' }, bundle) {
    const text = { params: { [constants.BROTLI_PARAM_MODE]: constants.BROTLI_MODE_TEXT } };
    await Promise.all(
      Object.keys(bundle).flatMap((name) => {
        const path = join(dir, name);
        const to = (end: string, how: NodeJS.ReadWriteStream): Promise<void> =>
          pipeline(createReadStream(path), how, createWriteStream(path + end));
        return [to('.br', createBrotliCompress(text)), to('.gz', createGzip({ level: 9 }))];
      }),
    );
  },
};

export default defineConfig({
  // Relative, so that the page also works behind a proxy's path prefix.
  base: './',
  plugins: [compressed],
  build: {
    target: 'es2022',
    // The server's Content-Security-Policy has no data: URLs for our assets.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
  },
  css: {
    postcss: {
      plugins: [
        {
          // lil-gui's icons come as a data: URL too, which Chromium loads even where unused;
          // panel.css draws them with plain characters.
          postcssPlugin: 'no-data-fonts',
          AtRule: { 'font-face': (rule) => void rule.remove() },
        },
      ],
    },
  },
  worker: { format: 'es' },
  server: {
    proxy: {
      '/ws': { target: 'ws://127.0.0.1:8080', ws: true },
      '/rooms/ws': { target: 'ws://127.0.0.1:8080', ws: true },
      '/settings.json': 'http://127.0.0.1:8080',
      '/view': 'http://127.0.0.1:8080',
    },
  },
  test: { include: ['test/**/*.test.ts'] },
});
