// The Node example drives a server.

import { execFile } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

import { expect, it } from 'vitest';

import { startServer } from './server';

const kExample = fileURLToPath(new URL('../examples/drive.mjs', import.meta.url));

it('DriveExample_AgainstAServer_IsWelcomedAndGetsFrames', async () => {
  const server = await startServer();
  try {
    const url = `${server.url.replace('http:', 'ws:')}ws`;
    const { stdout, stderr } = await promisify(execFile)('node', [kExample, url]);
    const lines = stdout.trim().split('\n');
    expect(stderr).toBe('');
    expect(lines).toContain('welcome');
    expect(lines).toContain('state');
    expect(lines).not.toContain('error');
    // The server sends two without acknowledgements.
    expect(Number(/^(\d+) frames$/.exec(lines.at(-1) ?? '')?.[1])).toBeGreaterThan(2);
  } finally {
    expect(await server.stop()).toBe(0);
  }
});
