// What a frame's payload has for one picture.

/** A picture that stands alone, or the next frame of video. */
export interface EncodedPart {
  /** Of video: decodes without any frame before it. */
  readonly key: boolean;
  readonly width: number;
  readonly height: number;
  readonly bytes: Uint8Array<ArrayBuffer>;
}
