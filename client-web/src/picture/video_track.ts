// One viewer's video, by WebCodecs: frames go in as they came and each comes out at once. Runs in
// the decode worker; knows no messages.

import type { EncodedPart } from './encoded_part';

/** The frame cannot be decoded before a key frame has come. */
export class LostSync extends Error {
  /** `broken`: the decoder failed at this frame; else it only waits for a key frame. */
  constructor(
    message: string,
    readonly broken: boolean,
  ) {
    super(message);
  }
}

/** The part of VideoDecoder that is used. */
export type Decoder = Pick<VideoDecoder, 'configure' | 'decode' | 'close'>;

export interface VideoEnvironment {
  /** WebCodecs' name of what a key frame begins. */
  readonly nameOf: (keyFrame: Uint8Array) => string;
  readonly open: (init: VideoDecoderInit) => Decoder;
  /** Returns how to cancel. */
  readonly after: (delayMs: number, action: () => void) => () => void;
}

interface Waiting {
  readonly resolve: (frame: VideoFrame) => void;
  readonly reject: (error: LostSync) => void;
  readonly cancel: () => void;
}

/** A decoder that gives nothing for so long holds its frames back, and would for ever. */
const kHeldMs = 2_000;

/** As the protocol says. Chromium takes it for limited-range BT.709 when not told, whatever a frame says. */
const kColorSpace: VideoColorSpaceInit = {
  primaries: 'bt709',
  transfer: 'iec61966-2-1',
  matrix: 'smpte170m',
  fullRange: true,
};

export class VideoTrack {
  private decoder: Decoder | null = null; // null: only a key frame will do
  private configured = '';
  private readonly waiting = new Map<number, Waiting>(); // by time stamp
  private next = 0;

  constructor(private readonly env: VideoEnvironment) {}

  /** The caller closes the frame. Rejects with LostSync. */
  decode(chunk: EncodedPart): Promise<VideoFrame> {
    return new Promise((resolve, reject) => {
      if (chunk.key) this.prepare(chunk);
      const { decoder } = this;
      if (!decoder) {
        reject(new LostSync('video: waits for a key frame', false));
        return;
      }
      const timestamp = this.next++;
      const cancel = this.env.after(kHeldMs, () =>
        this.close(`no picture within ${kHeldMs / 1000} s`),
      );
      this.waiting.set(timestamp, { resolve, reject, cancel });
      try {
        const type = chunk.key ? 'key' : 'delta';
        decoder.decode(new EncodedVideoChunk({ type, timestamp, data: chunk.bytes }));
      } catch (error) {
        this.close(String(error));
      }
    });
  }

  /** Makes the decoder ready for what the key frame begins; what is in it still comes out. */
  private prepare({ bytes, width, height }: EncodedPart): void {
    const codec = this.env.nameOf(bytes);
    const configuration = `${codec} ${width}x${height}`;
    if (this.decoder && this.configured === configuration) return;
    this.decoder ??= this.open();
    this.configured = configuration;
    this.decoder.configure({
      codec,
      codedWidth: width,
      codedHeight: height,
      optimizeForLatency: true,
      colorSpace: kColorSpace,
    });
  }

  private open(): Decoder {
    const decoder = this.env.open({
      output: (frame) => this.output(frame),
      error: (error) => {
        if (decoder === this.decoder) this.close(error.message);
      },
    });
    return decoder;
  }

  private output(frame: VideoFrame): void {
    const entry = this.waiting.get(frame.timestamp);
    if (!entry) {
      frame.close();
      return;
    }
    this.waiting.delete(frame.timestamp);
    entry.cancel();
    entry.resolve(frame);
  }

  /** Whatever is in the decoder is lost. */
  private close(why: string): void {
    const { decoder } = this;
    this.decoder = null;
    let broken = true; // one failure, however many frames it takes with it
    for (const { reject, cancel } of this.waiting.values()) {
      cancel();
      reject(new LostSync(`video: ${why}`, broken));
      broken = false;
    }
    this.waiting.clear();
    try {
      decoder?.close();
    } catch {
      // An error has closed it already.
    }
  }
}
