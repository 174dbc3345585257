// Frames to bitmaps, off the main thread.

import type { Frame } from '../protocol/framing';
import type { FrameHeader } from '../gen/froxel/v1/server_pb';
import { kCodecs, rowOf } from './codecs';
import { Codec } from '../gen/froxel/v1/common_pb';
import { LostSync } from './video_track';

export interface DecodeRequest {
  readonly id: number;
  readonly width: number;
  readonly height: number;
  readonly parts: readonly {
    readonly offset: number;
    readonly length: number;
    readonly x: number;
    readonly y: number;
    readonly codec: Codec;
    readonly keyFrame: boolean;
  }[];
  readonly bytes: Uint8Array<ArrayBuffer>;
}

export type DecodeReply =
  | { readonly id: number; readonly bitmap: ImageBitmap }
  | {
      readonly id: number;
      readonly error: string;
      /** Of video: whether the decoder failed, or waits for a key frame. */
      readonly lost?: 'broken' | 'waiting';
    };

/**
 * The caller owns the bitmap and closes it. Rejects with one line for a person; with LostSync where
 * video needs a key frame. Video comes in the order of its frames, none left out.
 */
export type Decode = (frame: Frame) => Promise<ImageBitmap>;

/** The part of Worker that is used. */
export interface WorkerPort {
  postMessage(request: DecodeRequest, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<DecodeReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

const isVideo = ({ parts }: FrameHeader): boolean =>
  parts.some(({ codec }) => rowOf(codec)?.framesDepend);

function decodedCodecs(): string {
  const names = kCodecs.map(({ codec }) => Codec[codec]);
  return `${names.slice(0, -1).join(', ')} and ${names.at(-1)}`;
}

/** Whether a frame is of use only after all since the last one that is not. */
export const needsOthers = (header: FrameHeader): boolean =>
  isVideo(header) && !header.parts.every(({ keyFrame }) => keyFrame);

export function workerDecoder(worker: WorkerPort): Decode {
  interface Waiting {
    readonly resolve: (bitmap: ImageBitmap) => void;
    readonly reject: (error: Error) => void;
  }
  const waiting = new Map<number, Waiting>();
  let next = 0;

  worker.onmessage = ({ data }) => {
    const entry = waiting.get(data.id);
    waiting.delete(data.id);
    if ('bitmap' in data) entry?.resolve(data.bitmap);
    else if (data.lost) entry?.reject(new LostSync(data.error, data.lost === 'broken'));
    else entry?.reject(new Error(data.error));
  };
  worker.onerror = (event) => {
    for (const { reject } of waiting.values()) reject(new Error(`decoder: ${event.message}`));
    waiting.clear();
  };

  return ({ header, payload }) =>
    new Promise((resolve, reject) => {
      if (header.parts.length === 0) {
        reject(new Error(`frame ${header.frameId} has no picture in it`));
        return;
      }
      const odd = header.parts.find(({ codec }) => !rowOf(codec));
      if (odd) {
        reject(new Error(`frame of codec ${odd.codec}; this page decodes ${decodedCodecs()}`));
        return;
      }
      if (isVideo(header) && header.parts.length > 1) {
        reject(new Error(`frame of ${header.parts.length} parts of video; one is needed`));
        return;
      }
      const id = next++;
      waiting.set(id, { resolve, reject });
      const parts = header.parts.map(({ offset, length, x, y, codec, keyFrame }) => {
        return { offset, length, x, y, codec, keyFrame };
      });
      const { width } = header;
      const height = header.compared?.layered ? 2 * header.height : header.height;
      // The message's buffer goes to the worker; nobody reads the payload here afterwards.
      worker.postMessage({ id, width, height, parts, bytes: payload }, [payload.buffer]);
    });
}
