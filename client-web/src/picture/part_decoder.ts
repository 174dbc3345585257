// Encoded parts to bitmaps by what a browser has. Runs in the decode worker.

import type { EncodedPart } from './encoded_part';
import { VideoTrack } from './video_track';

export interface PartDecoder {
  /** The caller closes the bitmap. Rejects with LostSync where video needs a key frame. */
  decode(part: EncodedPart): Promise<ImageBitmap>;
}

/** Of a media type whose pictures stand alone. */
export const stillDecoder = (type: string): PartDecoder => ({
  decode: ({ bytes }) => createImageBitmap(new Blob([bytes], { type })),
});

/** `nameOf` gives WebCodecs' name of what a key frame begins. */
export function videoDecoder(nameOf: (keyFrame: Uint8Array) => string): PartDecoder {
  const track = new VideoTrack({
    nameOf,
    open: (init) => new VideoDecoder(init),
    after: (delayMs, action) => {
      const timer = setTimeout(action, delayMs);
      return () => clearTimeout(timer);
    },
  });
  return {
    async decode(part) {
      const frame = await track.decode(part);
      try {
        return await createImageBitmap(frame);
      } finally {
        frame.close();
      }
    },
  };
}
