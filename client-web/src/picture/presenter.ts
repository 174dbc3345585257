// Frames on their way to the canvas: at most two are being decoded, the newest wins everywhere (of
// video each is decoded, in order, and the newest painted), and each one is acknowledged when it was
// painted or given up. A hidden page begins no decoding and acknowledges only frames that fail, so
// that the server pauses.

import type { FrameHeader } from '../gen/froxel/v1/server_pb';
import type { Frame } from '../protocol/framing';
import { needsOthers, type Decode } from './decoder';
import { LostSync } from './video_track';

const kMaxDecodes = 2;

export interface PresenterEnvironment {
  readonly decode: Decode;
  readonly nextFrame: (action: () => void) => void;
  readonly nowMs: () => number;
  /** The bitmap is its to close. */
  readonly paint: (bitmap: ImageBitmap, header: FrameHeader) => void;
  readonly acknowledge: (ack: FrameTimes) => void;
  readonly painted: (header: FrameHeader, decodeMs: number) => void;
  readonly problem: (text: string) => void;
  /** Video cannot go on without a key frame. */
  readonly lostSync: (error: LostSync) => void;
}

/** What an acknowledgement tells of a frame, so that the server does not take our time for the link's. */
export interface FrameTimes {
  readonly frameId: bigint;
  readonly receiveToPaintUs: number;
  readonly decodeUs: number;
}

interface Waiting {
  readonly frame: Frame;
  readonly receivedMs: number;
}

interface Ready {
  readonly header: FrameHeader;
  readonly receivedMs: number;
  readonly bitmap: ImageBitmap;
  readonly decodeMs: number;
}

export class Presenter {
  /** Frames that arrived and were never shown, since the page was opened. */
  droppedCount = 0;

  private waiting: Waiting[] = []; // more than one only of video
  private ready: Ready | null = null;
  private decodes = 0;
  private lastId = 0n; // newest frame decoded so far
  private ackedId = 0n; // an acknowledgement covers all frames before it
  private generation = 0; // of the connection; what an older one left behind is ignored
  private visible = true;
  private paintPending = false;

  constructor(private readonly env: PresenterEnvironment) {}

  offer(frame: Frame): void {
    if (!needsOthers(frame.header)) {
      for (const old of this.waiting) this.drop(old.frame.header, old.receivedMs);
      this.waiting = [];
    }
    this.waiting.push({ frame, receivedMs: this.env.nowMs() });
    this.decodeNext();
  }

  setVisible(visible: boolean): void {
    this.visible = visible;
    if (!visible) return;
    this.decodeNext();
    this.schedulePaint();
  }

  /** A new connection counts its frames from 1; the last picture stays. */
  restart(): void {
    this.generation += 1;
    this.waiting = [];
    this.ready?.bitmap.close();
    this.ready = null;
    this.lastId = 0n;
    this.ackedId = 0n;
  }

  private decodeNext(): void {
    if (!this.visible || this.decodes >= kMaxDecodes) return;
    const next = this.waiting.shift();
    if (!next) return;
    const { frame, receivedMs } = next;
    const { header } = frame;
    this.decodes += 1;
    const { generation } = this;
    const startMs = this.env.nowMs();
    this.env.decode(frame).then(
      (bitmap) => {
        this.decodes -= 1;
        if (generation === this.generation) {
          this.decoded({ header, receivedMs, bitmap, decodeMs: this.env.nowMs() - startMs });
        } else {
          bitmap.close();
        }
        this.decodeNext();
      },
      (error: unknown) => {
        this.decodes -= 1;
        if (generation === this.generation) {
          this.droppedCount += 1;
          // Even while hidden: there may be no later picture to cover it, and the window would stay shut.
          this.acknowledge(header, receivedMs, 0);
          if (error instanceof LostSync) this.env.lostSync(error);
          else this.env.problem(error instanceof Error ? error.message : String(error));
        }
        this.decodeNext();
      },
    );
  }

  private decoded(next: Ready): void {
    if (next.header.frameId <= this.lastId) {
      next.bitmap.close();
      this.drop(next.header, next.receivedMs, next.decodeMs);
      return;
    }
    this.lastId = next.header.frameId;
    if (this.ready) {
      this.ready.bitmap.close();
      this.drop(this.ready.header, this.ready.receivedMs, this.ready.decodeMs);
    }
    this.ready = next;
    this.schedulePaint();
  }

  private schedulePaint(): void {
    if (this.paintPending || !this.ready) return;
    this.paintPending = true;
    this.env.nextFrame(() => {
      this.paintPending = false;
      this.paintReady();
    });
  }

  private paintReady(): void {
    const { ready } = this;
    if (!ready || !this.visible) return;
    this.ready = null;
    this.env.paint(ready.bitmap, ready.header);
    this.acknowledge(ready.header, ready.receivedMs, ready.decodeMs);
    this.env.painted(ready.header, ready.decodeMs);
  }

  /** A newer one is there; of a hidden page its acknowledgement covers this one. */
  private drop(header: FrameHeader, receivedMs: number, decodeMs = 0): void {
    this.droppedCount += 1;
    if (this.visible) this.acknowledge(header, receivedMs, decodeMs);
  }

  private acknowledge({ frameId }: FrameHeader, receivedMs: number, decodeMs: number): void {
    if (frameId <= this.ackedId) return;
    this.ackedId = frameId;
    this.env.acknowledge({
      frameId,
      receiveToPaintUs: micros(this.env.nowMs() - receivedMs),
      decodeUs: micros(decodeMs),
    });
  }
}

/** As a uint32: an hour is as good as for ever. */
const micros = (ms: number): number => Math.min(3_600_000_000, Math.max(0, Math.round(ms * 1000)));
