// A link between a page and a server: each byte comes later by a delay, and no faster than a rate.

import { connect, createServer, type Socket } from 'node:net';

export interface LinkOptions {
  readonly delayMs: number; // each way
  readonly downBitsPerS: number; // to the page; Infinity: as fast as it comes
}

export interface Relay {
  readonly port: number;
  close(): void;
}

/** Bytes that may be on their way before the sender has to wait. */
const kQueueBytes = 256 * 1024;

function pump(from: Socket, to: Socket, { delayMs, bitsPerS }: { delayMs: number; bitsPerS: number }): void {
  let freeAtMs = 0; // when the link has sent what came before
  let queued = 0;
  from.on('data', (data: Buffer) => {
    const nowMs = performance.now();
    freeAtMs = Math.max(freeAtMs, nowMs) + (data.length * 8_000) / bitsPerS;
    queued += data.length;
    if (queued > kQueueBytes) from.pause();
    setTimeout(() => {
      queued -= data.length;
      if (queued <= kQueueBytes) from.resume();
      if (!to.destroyed) to.write(data);
    }, freeAtMs - nowMs + delayMs);
  });
  from.on('close', () => setTimeout(() => to.destroy(), delayMs));
  from.on('error', () => to.destroy());
}

export function startRelay(serverPort: number, { delayMs, downBitsPerS }: LinkOptions): Promise<Relay> {
  const sockets = new Set<Socket>();
  const listener = createServer((page) => {
    const server = connect(serverPort, '127.0.0.1');
    for (const socket of [page, server]) {
      socket.setNoDelay(true);
      sockets.add(socket);
      socket.on('close', () => sockets.delete(socket));
    }
    pump(page, server, { delayMs, bitsPerS: Infinity });
    pump(server, page, { delayMs, bitsPerS: downBitsPerS });
  });
  return new Promise((resolve) => {
    listener.listen(0, '127.0.0.1', () => {
      const address = listener.address();
      if (address === null || typeof address === 'string') throw new Error('no port');
      const close = (): void => {
        listener.close();
        for (const socket of sockets) socket.destroy();
      };
      resolve({ port: address.port, close });
    });
  });
}
