import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['e2e/**/*.e2e.ts'],
    // A software device on a busy machine may take seconds for a frame; conditions are awaited,
    // these are only the ends of patience.
    testTimeout: 900_000,
    hookTimeout: 300_000,
    // Files have servers and browsers of their own, and mostly wait. More at once would only starve each other.
    maxWorkers: 2,
    minWorkers: 1,
  },
});
