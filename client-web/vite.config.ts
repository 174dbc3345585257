import { defineConfig } from 'vitest/config';

export default defineConfig({
  // Relative, so that the page also works behind a proxy's path prefix.
  base: './',
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
      '/settings.json': 'http://127.0.0.1:8080',
    },
  },
  test: { include: ['test/**/*.test.ts'] },
});
