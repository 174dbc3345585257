// A server that goes down and names another one.

import { createServer, type AddressInfo } from 'node:net';

import { expect, it } from 'vitest';

import type { ServerMessage } from '../src/gen/froxel/v1/server_pb';
import { launch } from './chromium';
import { startServer } from './server';
import { until, Viewer } from './viewer';

function freePort(): Promise<number> {
  return new Promise((resolve) => {
    const taken = createServer().listen(0, '127.0.0.1', () => {
      const { port } = taken.address() as AddressInfo;
      taken.close(() => resolve(port));
    });
  });
}

it('AdvertisedServer_ThePageGoesThereAndComesBackThere', async () => {
  const port = await freePort();
  // Pages of the first one's origin must be let in.
  const options = ['--allow-origin', `http://127.0.0.1:${port}`];
  let second = await startServer(0, options);
  const socketUrl = `${second.url.replace('http:', 'ws:')}ws`;
  const [first, browser] = await Promise.all([startServer(port, ['--advertise', socketUrl]), launch()]);
  try {
    const viewer = await Viewer.open(browser, 'about:blank');
    const sockets: string[] = [];
    viewer.page.on('websocket', (socket) => sockets.push(socket.url()));
    await viewer.page.goto(`${first.url}#size=320x180&animate=0&lights=50`);
    await viewer.picture();
    await viewer.openPanel();
    await viewer.type('lights', 123);
    await viewer.stateWith('123 lights', ({ lightCount }) => lightCount === 123);

    const heard = viewer.received.length;
    const frames = viewer.frameCount;
    expect(await first.stop()).toBe(0);
    const told = (): ServerMessage[] => viewer.received.slice(heard);
    await until('a welcome', () => told().some(({ body }) => body.case === 'welcome'));
    expect(told().find(({ body }) => body.case === 'draining')?.body.value).toMatchObject({
      reconnectUrl: socketUrl,
    });
    expect(sockets.slice(1)).toEqual([socketUrl]);
    await viewer.stateWith('what it was', ({ lightCount }) => lightCount === 123);
    await until('new frames', () => viewer.frameCount > frames);

    // The first one is gone for good: a lost connection is taken up where it was lost.
    const later = viewer.received.length;
    expect(await second.stop()).toBe(0);
    second = await startServer(second.port, options);
    await until('a welcome', () =>
      viewer.received.slice(later).some(({ body }) => body.case === 'welcome'));
    expect(sockets.at(-1)).toBe(socketUrl);
  } finally {
    await browser.close();
    expect(await second.stop()).toBe(0);
  }
});
