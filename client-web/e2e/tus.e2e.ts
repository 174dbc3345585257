// tus-js-client, whose makers wrote the protocol, against the server's uploads: core, creation, termination, expiration.

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { type HttpResponse, Upload, type UploadOptions } from 'tus-js-client';
import { afterAll, beforeAll, expect, it } from 'vitest';

import { type Server, startServer } from './server';

const folder = mkdtempSync(join(tmpdir(), 'froxel_tus_'));
let server: Server;
beforeAll(async () => {
  server = await startServer(0, ['--uploads', 'on', '--upload-folder', folder]);
});
afterAll(async () => {
  await server.stop();
  rmSync(folder, { recursive: true });
});

const kScene = Buffer.from('{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{}]}'.padEnd(200_000));

interface Sent {
  readonly upload: Upload;
  readonly url: string;
  readonly answers: readonly HttpResponse[];
}

/** Sends the scene to its end, or up to what `until` says. */
function send(options: Partial<UploadOptions> = {}, until = Infinity): Promise<Sent> {
  return new Promise((done, failed) => {
    const answers: HttpResponse[] = [];
    const end = (): void => done({ upload, url: upload.url ?? '', answers });
    const upload = new Upload(kScene, {
      endpoint: new URL('/api/v1/uploads', server.url).href,
      metadata: { filename: 'a.gltf' },
      chunkSize: 50_000,
      retryDelays: null,
      onAfterResponse: (_, answer) => void answers.push(answer),
      onError: failed,
      onSuccess: end,
      onChunkComplete: (_, accepted) => {
        if (accepted >= until && accepted < kScene.length) void upload.abort().then(end);
      },
      ...options,
    });
    upload.start();
  });
}

const offsetOf = async (url: string): Promise<{ status: number; offset: string | null }> => {
  const answer = await fetch(url, { method: 'HEAD', headers: { 'Tus-Resumable': '1.0.0' } });
  return { status: answer.status, offset: answer.headers.get('Upload-Offset') };
};

it('CreatesAndSends_InParts', async () => {
  const { url, answers } = await send();
  expect(answers.map((answer) => answer.getStatus())).toEqual([201, 204, 204, 204, 204]);
  expect(Date.parse(answers[0]?.getHeader('Upload-Expires') ?? '')).toBeGreaterThan(Date.now());
  expect(await offsetOf(url)).toEqual({ status: 200, offset: '200000' });
});

it('GoesOn_WhereAnotherLeftOff', async () => {
  const { url } = await send({}, 100_000);
  expect((await offsetOf(url)).offset).toBe('100000');
  const { answers } = await send({ uploadUrl: url });
  expect(answers.map((answer) => answer.getStatus())).toEqual([200, 204, 204]);
  expect((await offsetOf(url)).offset).toBe('200000');
});

it('Terminates', async () => {
  const { upload, url } = await send({}, 50_000);
  await upload.abort(true);
  expect((await offsetOf(url)).status).toBe(404);
});

it('AWrongOffset_IsRefused', async () => {
  const { url } = await send({}, 50_000);
  const headers = { 'Tus-Resumable': '1.0.0', 'Content-Type': 'application/offset+octet-stream', 'Upload-Offset': '49999' };
  expect((await fetch(url, { method: 'PATCH', headers, body: 'x' })).status).toBe(409);
});
