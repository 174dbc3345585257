// The reports of `froxel bench` and, with `--mode load` or `--mode diff`, of `froxel load` and `froxel diff`: each one
// file with script and style inside, beside the page's other files. The command puts its JSON into the file's place for results.
import { fileURLToPath } from 'node:url';

import { defineConfig } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

const folder = fileURLToPath(new URL('.', import.meta.url));

export default defineConfig(({ mode }) => ({
  root: folder,
  plugins: [viteSingleFile({ removeViteModuleLoader: true })],
  build: {
    target: 'es2022',
    outDir: `${folder}../dist`,
    emptyOutDir: false, // the page's files are there
    rollupOptions: { input: `${folder}${['load', 'diff'].includes(mode) ? mode : 'report'}.html` },
  },
}));
