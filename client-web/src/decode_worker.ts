// Worker: encoded parts to one bitmap.

import type { DecodeRequest, DecodeReply } from './decoder';

const scope = self as unknown as {
  onmessage: ((event: MessageEvent<DecodeRequest>) => void) | null;
  postMessage(reply: DecodeReply, transfer: Transferable[]): void;
};

scope.onmessage = ({ data }) => {
  decode(data).then(
    (bitmap) => scope.postMessage({ id: data.id, bitmap }, [bitmap]),
    (error: unknown) => scope.postMessage({ id: data.id, error: String(error) }, []),
  );
};

async function decode({ width, height, parts, bytes }: DecodeRequest): Promise<ImageBitmap> {
  const images = await Promise.all(
    parts.map((part) => {
      const encoded = bytes.subarray(part.offset, part.offset + part.length);
      return createImageBitmap(new Blob([encoded], { type: 'image/jpeg' }));
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
