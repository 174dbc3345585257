// The video decoder's care, with a decoder of our own: WebCodecs itself is tested in the browser.

import { beforeEach, describe, expect, it, vi } from 'vitest';

import type { EncodedPart } from '../../src/picture/encoded_part';
import { VideoFallback } from '../../src/picture/video_fallback';
import { LostSync, VideoTrack, type Decoder } from '../../src/picture/video_track';
import { vp9NameOf } from '../../src/picture/vp9';

class FakeDecoder implements Decoder {
  readonly configurations: VideoDecoderConfig[] = [];
  readonly chunks: { type: string; timestamp: number }[] = [];
  closed = false;
  refuses = false;

  constructor(readonly init: VideoDecoderInit) {}

  configure(config: VideoDecoderConfig): void {
    this.configurations.push(config);
  }
  decode(chunk: EncodedVideoChunk): void {
    if (this.refuses) throw new Error('closed codec');
    this.chunks.push(chunk);
  }
  close(): void {
    this.closed = true;
  }
  /** The oldest chunk's picture. */
  give(): FakeFrame {
    const { timestamp } = this.chunks.shift() ?? { timestamp: -1 };
    const frame = new FakeFrame(timestamp);
    this.init.output(frame as unknown as VideoFrame);
    return frame;
  }
  breakDown(): void {
    this.init.error(new DOMException('corrupt frame'));
  }
}

class FakeFrame {
  closed = false;
  constructor(readonly timestamp: number) {}
  close(): void {
    this.closed = true;
  }
}

let decoders: FakeDecoder[];
let timers: Set<() => void>;
let track: VideoTrack;

const chunk = (key: boolean, width = 64, first = 0x82): EncodedPart => ({
  key,
  width,
  height: 32,
  bytes: new Uint8Array([first, 1, 2]),
});
const lost = async (decoded: Promise<VideoFrame>): Promise<boolean> => {
  const error: unknown = await decoded.catch((reason: unknown) => reason);
  if (!(error instanceof LostSync)) throw new Error('not lost');
  return error.broken;
};

beforeEach(() => {
  vi.stubGlobal(
    'EncodedVideoChunk',
    class {
      readonly type: string;
      readonly timestamp: number;
      constructor({ type, timestamp }: EncodedVideoChunkInit) {
        this.type = type;
        this.timestamp = timestamp;
      }
    },
  );
  decoders = [];
  timers = new Set();
  track = new VideoTrack({
    nameOf: vp9NameOf,
    open: (init) => {
      const decoder = new FakeDecoder(init);
      decoders.push(decoder);
      return decoder;
    },
    after: (_, action) => {
      timers.add(action);
      return () => void timers.delete(action);
    },
  });
});

describe('VideoTrack', () => {
  it('Frames_ComeOutAsTheyWentIn', async () => {
    const frames = [track.decode(chunk(true)), track.decode(chunk(false))];
    expect(decoders[0]?.chunks.map(({ type }) => type)).toEqual(['key', 'delta']);
    const given = [decoders[0]?.give(), decoders[0]?.give()];
    expect(await Promise.all(frames)).toEqual(given);
    expect(timers.size).toBe(0);
  });

  it('Configuration_IsForLatencyAndNamesTheProfile', () => {
    void track.decode(chunk(true));
    void track.decode(chunk(true, 65, 0xa2));
    expect(decoders.length).toBe(1);
    expect(decoders[0]?.configurations).toMatchObject([
      { codec: 'vp09.00.62.08', codedWidth: 64, codedHeight: 32, optimizeForLatency: true },
      { codec: 'vp09.01.62.08', codedWidth: 65, colorSpace: { fullRange: true } },
    ]);
  });

  it('AnotherSize_LosesNothing', async () => {
    const frames = [64, 64, 80].map((width) => track.decode(chunk(true, width)));
    expect(decoders[0]?.configurations.length).toBe(2);
    const given = [0, 1, 2].map(() => decoders[0]?.give());
    expect(await Promise.all(frames)).toEqual(given);
  });

  it('NoKeyFrameYet_OnlyWaits', async () => {
    expect(await lost(track.decode(chunk(false)))).toBe(false);
    expect(decoders).toEqual([]);
  });

  it('DecoderFails_AllIsLostAsOneFailureUpToTheNextKeyFrame', async () => {
    const frames = [track.decode(chunk(true)), track.decode(chunk(false))];
    decoders[0]?.breakDown();
    expect(await Promise.all(frames.map(lost))).toEqual([true, false]);
    expect(await lost(track.decode(chunk(false)))).toBe(false);
    const again = track.decode(chunk(true));
    expect(decoders.length).toBe(2);
    decoders[0]?.breakDown(); // late news of the old one
    const frame = decoders[1]?.give();
    expect(await again).toBe(frame);
  });

  it('DecoderThatRefusesOrHolds_IsGivenUp', async () => {
    const held = track.decode(chunk(true));
    for (const action of [...timers]) action();
    expect(await lost(held)).toBe(true);
    expect(decoders[0]?.closed).toBe(true);
    expect(decoders[0]?.give().closed).toBe(true); // too late: nobody waits for it
    const first = track.decode(chunk(true));
    decoders[1]?.give();
    await first;
    if (decoders[1]) decoders[1].refuses = true;
    expect(await lost(track.decode(chunk(false)))).toBe(true);
  });
});

describe('VideoFallback', () => {
  it('Failures_AskForKeyFramesAndThenForJpeg', () => {
    const fallback = new VideoFallback();
    expect([0, 1000, 2000].map((at) => fallback.lost(true, at))).toEqual([
      'key frame',
      'key frame',
      'plain codec',
    ]);
    expect(fallback.lost(true, 2500)).toBe('key frame'); // chosen again by hand: a new start
  });

  it('RareFailures_NeverEndInJpeg', () => {
    const fallback = new VideoFallback();
    for (let at = 0; at < 1e6; at += 20_000) expect(fallback.lost(true, at)).toBe('key frame');
  });

  it('FramesThatOnlyWait_AskAgainNowAndThen', () => {
    const fallback = new VideoFallback();
    fallback.lost(true, 0);
    expect(fallback.lost(false, 100)).toBe('wait');
    expect(fallback.lost(false, 1999)).toBe('wait');
    expect(fallback.lost(false, 2000)).toBe('key frame');
    expect(fallback.lost(false, 2100)).toBe('wait');
  });
});
