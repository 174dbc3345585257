// Frames to bitmaps, off the main thread.

import type { Frame } from './framing';
import { Codec } from './gen/froxel/v1/server_pb';

export interface DecodeRequest {
  readonly id: number;
  readonly width: number;
  readonly height: number;
  readonly parts: readonly {
    readonly offset: number;
    readonly length: number;
    readonly x: number;
    readonly y: number;
  }[];
  readonly bytes: Uint8Array<ArrayBuffer>;
}

export type DecodeReply =
  | { readonly id: number; readonly bitmap: ImageBitmap }
  | { readonly id: number; readonly error: string };

/** The caller owns the bitmap and closes it. Rejects with one line for a person. */
export type Decode = (frame: Frame) => Promise<ImageBitmap>;

/** The part of Worker that is used. */
export interface WorkerPort {
  postMessage(request: DecodeRequest, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<DecodeReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

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
      const odd = header.parts.find((part) => part.codec !== Codec.JPEG);
      if (odd) {
        reject(new Error(`frame of codec ${odd.codec}; this page decodes JPEG`));
        return;
      }
      const id = next++;
      waiting.set(id, { resolve, reject });
      const parts = header.parts.map(({ offset, length, x, y }) => ({ offset, length, x, y }));
      const { width, height } = header;
      // The message's buffer goes to the worker; nobody reads the payload here afterwards.
      worker.postMessage({ id, width, height, parts, bytes: payload }, [payload.buffer]);
    });
}
