// Worker: encoded parts to one bitmap.

import { rowOf } from './codecs';
import type { DecodeReply, DecodeRequest } from './decoder';
import type { Codec } from '../gen/froxel/v1/common_pb';
import type { PartDecoder } from './part_decoder';
import { LostSync } from './video_track';

const scope = self as unknown as {
  onmessage: ((event: MessageEvent<DecodeRequest>) => void) | null;
  postMessage(reply: DecodeReply, transfer: Transferable[]): void;
};

const decoders = new Map<Codec, PartDecoder>();

scope.onmessage = ({ data }) => {
  decode(data).then(
    (bitmap) => scope.postMessage({ id: data.id, bitmap }, [bitmap]),
    (error: unknown) => {
      if (error instanceof LostSync) {
        const lost = error.broken ? 'broken' : 'waiting';
        scope.postMessage({ id: data.id, error: error.message, lost }, []);
      } else {
        scope.postMessage({ id: data.id, error: String(error) }, []);
      }
    },
  );
};

function decoderOf(codec: Codec): PartDecoder {
  const decoder = decoders.get(codec) ?? rowOf(codec)?.makeDecoder();
  if (!decoder) throw new Error(`no decoder of codec ${codec}`);
  decoders.set(codec, decoder);
  return decoder;
}

async function decode({ width, height, parts, bytes }: DecodeRequest): Promise<ImageBitmap> {
  const images = await Promise.all(
    parts.map(({ offset, length, codec, keyFrame }) => {
      const encoded = bytes.subarray(offset, offset + length);
      return decoderOf(codec).decode({ key: keyFrame, width, height, bytes: encoded });
    }),
  );
  const [first] = images;
  if (images.length === 1 && first?.width === width && first.height === height) {
    return first;
  }
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d', { alpha: false });
  if (!context) throw new Error('no 2D canvas in this worker');
  images.forEach((image, index) => {
    const part = parts[index];
    if (part) context.drawImage(image, part.x, part.y);
    image.close();
  });
  return canvas.transferToImageBitmap();
}
