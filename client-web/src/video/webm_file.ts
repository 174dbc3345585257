// Pictures to a WebM file of VP9, by WebCodecs and Mediabunny. Fetched when a recording begins.

import { BufferTarget, canEncodeVideo, CanvasSource, Output, Quality, WebMOutputFormat } from 'mediabunny';

const kQuality = new Quality('very-high');
const kKeyFrameS = 2; // from one frame that players seek to to the next

export class WebmFile {
  private readonly canvas: OffscreenCanvas;
  private readonly context: OffscreenCanvasRenderingContext2D;
  private readonly target = new BufferTarget();
  private readonly output = new Output({ format: new WebMOutputFormat(), target: this.target });
  private readonly source: CanvasSource;

  private constructor(
    width: number,
    height: number,
    private readonly framesPerS: number,
  ) {
    this.canvas = new OffscreenCanvas(width, height);
    const context = this.canvas.getContext('2d', { alpha: false });
    if (!context) throw new Error('this browser draws no pictures outside the page');
    this.context = context;
    this.source = new CanvasSource(this.canvas, {
      codec: 'vp9',
      bitrate: kQuality,
      keyFrameInterval: kKeyFrameS,
    });
    this.output.addVideoTrack(this.source, { frameRate: framesPerS });
  }

  /** Throws where this browser encodes no such video. */
  static async begin(width: number, height: number, framesPerS: number): Promise<WebmFile> {
    const encodes = await canEncodeVideo('vp9', { width, height, bitrate: kQuality });
    if (!encodes) throw new Error(`this browser encodes no VP9 of ${width} × ${height}; it may need https`);
    const file = new WebmFile(width, height, framesPerS);
    await file.output.start();
    return file;
  }

  async add(picture: ImageBitmap, index: number): Promise<void> {
    this.context.drawImage(picture, 0, 0);
    picture.close();
    await this.source.add(index / this.framesPerS, 1 / this.framesPerS);
  }

  async finish(): Promise<Blob> {
    await this.output.finalize();
    const { buffer } = this.target;
    if (!buffer) throw new Error('the video has no content');
    return new Blob([buffer], { type: 'video/webm' });
  }

  cancel(): Promise<void> {
    return this.output.cancel();
  }
}
