// The report of `froxel bench`: one file with script and style inside, beside the page's other files.
// The bench command puts its JSON into the file's place for results.
import { fileURLToPath } from 'node:url';

import { defineConfig } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

const folder = fileURLToPath(new URL('.', import.meta.url));

export default defineConfig({
  root: folder,
  plugins: [viteSingleFile({ removeViteModuleLoader: true })],
  build: {
    target: 'es2022',
    outDir: `${folder}../dist`,
    emptyOutDir: false, // the page's files are there
    rollupOptions: { input: `${folder}report.html` },
  },
});
