import { defineConfig, mergeConfig } from 'vitest/config';

import tests from './vitest.config';

// Prints figures of a quiet machine; no test, since timing decides none.
export default mergeConfig(
  { ...tests, test: { ...tests.test, include: [] } },
  defineConfig({ test: { include: ['e2e/**/*.measure.ts'], disableConsoleIntercept: true } }),
);
