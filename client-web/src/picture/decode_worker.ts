// Worker: encoded parts to one bitmap.

import { stillType, type DecodeRequest, type DecodeReply } from './decoder';
import { Codec } from '../gen/froxel/v1/common_pb';
import { LostSync, VideoTrack } from './video_track';

const scope = self as unknown as {
  onmessage: ((event: MessageEvent<DecodeRequest>) => void) | null;
  postMessage(reply: DecodeReply, transfer: Transferable[]): void;
};

const video = new VideoTrack({
  open: (init) => new VideoDecoder(init),
  after: (delayMs, action) => {
    const timer = setTimeout(action, delayMs);
    return () => clearTimeout(timer);
  },
});

scope.onmessage = ({ data }) => {
  const [part] = data.parts;
  (part?.codec === Codec.VP9 ? decodeVideo(data, part.keyFrame) : decode(data)).then(
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

async function decodeVideo(
  { width, height, bytes }: DecodeRequest,
  key: boolean,
): Promise<ImageBitmap> {
  const frame = await video.decode({ key, width, height, bytes });
  try {
    return await createImageBitmap(frame);
  } finally {
    frame.close();
  }
}

async function decode({ width, height, parts, bytes }: DecodeRequest): Promise<ImageBitmap> {
  const images = await Promise.all(
    parts.map((part) => {
      const encoded = bytes.subarray(part.offset, part.offset + part.length);
      return createImageBitmap(new Blob([encoded], { type: stillType(part.codec) ?? '' }));
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
