// Starts and stops the froxel binary that FROXEL_BINARY names.

import { spawn, type ChildProcess } from 'node:child_process';
import { createInterface } from 'node:readline';

const kStartMs = 240_000;
const kStopMs = 30_000;

export interface Server {
  readonly url: string;
  readonly port: number;
  /** Stops it where it stands, as a network that carries nothing would, until it is to go on. */
  hold(held: boolean): void;
  /** Ends it by SIGTERM; resolves to its exit code. */
  stop(): Promise<number | null>;
}

/** Port 0: any free one. Rejects with what the binary said when it gives no URL. */
export async function startServer(port = 0, more: readonly string[] = []): Promise<Server> {
  const binary = process.env.FROXEL_BINARY;
  if (!binary) throw new Error('FROXEL_BINARY is not set: the path of a froxel binary');
  // However slow the machine, several pages are let in and their pictures drawn.
  const options = ['--port', String(port), '--admin-bind', 'none', '--min-fps', '0', '--frame-limit', '60'];
  options.push('--drain-seconds', '1', '--look', 'rainbow', ...more); // nothing that a test did not turn on
  const child = spawn(binary, ['serve', ...options], {
    stdio: ['ignore', 'pipe', 'pipe'],
    env: { FROXEL_UPLOADS: 'off', ...process.env }, // a test turns them on, with a folder of its own
  });
  const log: string[] = []; // the last of what it said
  child.stderr.on('data', (chunk: Buffer) => {
    log.push(chunk.toString());
    if (log.length > 100) log.shift();
  });
  const url = await firstUrl(child, log);
  const hold = (held: boolean): void => void child.kill(held ? 'SIGSTOP' : 'SIGCONT');
  return { url, port: Number(new URL(url).port), hold, stop: () => stop(child, log) };
}

function firstUrl(child: ChildProcess, log: readonly string[]): Promise<string> {
  return new Promise((resolve, reject) => {
    const fail = (why: string): void => reject(new Error(`froxel serve ${why}\n${log.join('')}`));
    const timer = setTimeout(() => {
      child.kill('SIGKILL');
      fail('gave no URL in time');
    }, kStartMs);
    child.once('error', (error) => fail(error.message));
    child.once('exit', (code) => fail(`ended with ${String(code)}`));
    if (!child.stdout) return;
    createInterface(child.stdout).on('line', (line) => {
      const url = /https?:\/\/\S+/.exec(line)?.[0];
      if (url === undefined) return;
      clearTimeout(timer);
      resolve(url);
    });
  });
}

function stop(child: ChildProcess, log: readonly string[]): Promise<number | null> {
  if (child.exitCode === 0) return Promise.resolve(0);
  if (child.signalCode !== null || child.exitCode !== null) {
    const end = child.signalCode ? `died of ${child.signalCode}` : `ended with ${String(child.exitCode)}`;
    throw new Error(`froxel serve had ${end}\n${log.join('')}`);
  }
  return new Promise((resolve) => {
    const timer = setTimeout(() => child.kill('SIGKILL'), kStopMs);
    child.once('exit', (code) => {
      clearTimeout(timer);
      resolve(code);
    });
    child.kill('SIGTERM');
  });
}
