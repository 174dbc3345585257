// A slow link between a page and a server: the program froxel_relay (tests/relay) of the build.

import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';

import { kBuild } from '../compare/programs';

export interface LinkOptions {
  readonly delayMs: number; // each way
  readonly kbitPerS: number; // each way; 0: no limit
}

export interface Relay {
  readonly port: number;
  close(): void;
}

export async function startRelay(serverPort: number, { delayMs, kbitPerS }: LinkOptions): Promise<Relay> {
  const options = ['--to', `127.0.0.1:${serverPort}`, '--delay-ms', String(delayMs), '--kbit-per-s', String(kbitPerS)];
  const child = spawn(`${kBuild}/tests/relay/froxel_relay`, options, { stdio: ['pipe', 'pipe', 'inherit'] });
  const line = await new Promise<string>((resolve, reject) => {
    child.once('error', reject);
    child.once('exit', (code) => reject(new Error(`froxel_relay ended with ${String(code)}`)));
    createInterface(child.stdout).once('line', resolve);
  });
  return { port: Number(line.split(':')[1]), close: () => child.stdin.end() };
}
