import { describe, expect, it } from 'vitest';

import {
  needsOthers,
  workerDecoder,
  type DecodeReply,
  type DecodeRequest,
  type WorkerPort,
} from '../../src/picture/decoder';
import type { Frame } from '../../src/protocol/framing';
import { Codec } from '../../src/gen/froxel/v1/common_pb';
import { LostSync } from '../../src/picture/video_track';
import { frameHeader } from '../fakes';

class FakeWorker implements WorkerPort {
  onmessage: WorkerPort['onmessage'] = null;
  onerror: WorkerPort['onerror'] = null;
  readonly requests: DecodeRequest[] = [];
  readonly transfers: Transferable[][] = [];

  postMessage(request: DecodeRequest, transfer: Transferable[]): void {
    this.requests.push(request);
    this.transfers.push(transfer);
  }

  reply(data: DecodeReply): void {
    this.onmessage?.(new MessageEvent('message', { data }));
  }
}

function frame(codec: Codec = Codec.JPEG): Frame {
  const parts = [{ offset: 0, length: 3, x: 0, y: 0, width: 4, height: 2, codec }];
  const header = frameHeader({ frameId: 5n, width: 4, height: 2, parts });
  return { header, payload: new Uint8Array([1, 2, 3]) };
}

const image = { width: 4, height: 2, close: () => undefined } satisfies ImageBitmap;

describe('workerDecoder', () => {
  it('Request_CarriesThePartsAndGivesTheBufferAway', () => {
    const worker = new FakeWorker();
    const asked = frame();
    void workerDecoder(worker)(asked);
    expect(worker.requests).toMatchObject([
      { width: 4, height: 2, parts: [{ offset: 0, length: 3, x: 0, y: 0, codec: Codec.JPEG }] },
    ]);
    expect(worker.transfers[0]).toEqual([asked.payload.buffer]);
  });

  it('Lossless_IsAskedForAsPng', () => {
    const worker = new FakeWorker();
    void workerDecoder(worker)(frame(Codec.PNG));
    expect(worker.requests[0]?.parts[0]?.codec).toBe(Codec.PNG);
  });

  it('Replies_FindTheirRequestsInAnyOrder', async () => {
    const worker = new FakeWorker();
    const decode = workerDecoder(worker);
    const [first, second] = [decode(frame()), decode(frame())];
    const other = { ...image };
    worker.reply({ id: 1, bitmap: other });
    worker.reply({ id: 0, bitmap: image });
    expect(await first).toBe(image);
    expect(await second).toBe(other);
  });

  it('Failure_Rejects', async () => {
    const worker = new FakeWorker();
    const decoded = workerDecoder(worker)(frame());
    worker.reply({ id: 0, error: 'not a JPEG' });
    await expect(decoded).rejects.toThrow('not a JPEG');
  });

  it('Failure_OfVideo_SaysWhetherTheDecoderBroke', async () => {
    const worker = new FakeWorker();
    const decode = workerDecoder(worker);
    const [first, second] = [decode(frame(Codec.VP9)), decode(frame(Codec.VP9))];
    worker.reply({ id: 0, error: 'video: gone', lost: 'broken' });
    worker.reply({ id: 1, error: 'video: waits', lost: 'waiting' });
    await expect(first).rejects.toEqual(new LostSync('video: gone', true));
    await expect(second).rejects.toMatchObject({ broken: false });
  });

  it('Video_InSeveralParts_IsRefused', async () => {
    const { header, payload } = frame(Codec.VP9);
    header.parts.push(...header.parts);
    const decoded = workerDecoder(new FakeWorker())({ header, payload });
    await expect(decoded).rejects.toThrow('2 parts of video');
  });

  it('NeedsOthers_OnlyVideoThatIsNoKeyFrame', () => {
    expect(needsOthers(frame(Codec.JPEG).header)).toBe(false);
    expect(needsOthers(frame(Codec.VP9).header)).toBe(true);
    const { header } = frame(Codec.VP9);
    for (const part of header.parts) part.keyFrame = true;
    expect(needsOthers(header)).toBe(false);
  });

  it('WorkerThatDies_RejectsAllThatWait', async () => {
    const worker = new FakeWorker();
    const decoded = workerDecoder(worker)(frame());
    worker.onerror?.({ message: 'gone' } as ErrorEvent);
    await expect(decoded).rejects.toThrow('gone');
  });

  it('UnknownCodecOrNoPicture_RejectsWithoutAsking', async () => {
    const worker = new FakeWorker();
    await expect(workerDecoder(worker)(frame(Codec.UNSPECIFIED))).rejects.toThrow(
      'frame of codec 0; this page decodes JPEG, PNG and VP9',
    );
    const empty = { header: frameHeader({ frameId: 6n }), payload: new Uint8Array() };
    await expect(workerDecoder(worker)(empty)).rejects.toThrow(/frame 6/);
    expect(worker.requests).toEqual([]);
  });
});
