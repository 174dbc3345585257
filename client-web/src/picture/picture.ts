// The canvas: paints bitmaps and saves the picture.

import type { Size } from '../core/size';
import { layerSize, stripsOf } from './layers';

/** The size that was asked for, by a picture of `scale` of it; the canvas has it already, mostly. */
export function canvasSize(canvas: Size, picture: Size, scale: number): Size {
  if (!(scale > 0) || scale >= 1) return { width: picture.width, height: picture.height };
  const fits = (whole: number, part: number): boolean => Math.abs(whole * scale - part) <= 1;
  if (fits(canvas.width, picture.width) && fits(canvas.height, picture.height)) return canvas;
  return { width: Math.round(picture.width / scale), height: Math.round(picture.height / scale) };
}

export class Picture {
  private readonly context: CanvasRenderingContext2D;
  private painted = false;
  private layers: ImageBitmap | null = null; // of the comparison that is shown
  private split = 0.5;

  constructor(private readonly canvas: HTMLCanvasElement) {
    const context = canvas.getContext('2d', { alpha: false });
    if (!context) throw new Error('this browser has no 2D canvas');
    this.context = context;
  }

  /** `scale` is the picture's, of the size asked for: the canvas keeps that size, and its place. */
  paint(bitmap: ImageBitmap, scale: number): void {
    this.layers?.close();
    this.layers = null;
    const size = this.fit(bitmap, scale);
    this.context.drawImage(bitmap, 0, 0, size.width, size.height);
  }

  /** Two pictures, one above the other, of which the divider shows a part each. The bitmap is this one's to close. */
  paintLayers(bitmap: ImageBitmap, scale: number): void {
    this.layers?.close();
    this.layers = bitmap;
    this.fit(layerSize(bitmap), scale);
    this.paintSides();
  }

  /** Where the divider of a comparison is, as a share of the width. */
  setSplit(split: number): void {
    if (split === this.split) return;
    this.split = split;
    this.paintSides();
  }

  private paintSides(): void {
    const { layers, canvas, split } = this;
    if (!layers) return;
    const layer = layerSize(layers);
    for (const { from, begin, end } of stripsOf(split, layers)) {
      const [x, width] = [begin * layer.width, (end - begin) * layer.width];
      const [toX, toWidth] = [begin * canvas.width, (end - begin) * canvas.width];
      this.context.drawImage(layers, x, from, width, layer.height, toX, 0, toWidth, canvas.height);
    }
  }

  private fit(picture: Size, scale: number): Size {
    const { canvas } = this;
    const size = canvasSize(canvas, picture, scale);
    if (canvas.width !== size.width || canvas.height !== size.height) {
      canvas.width = size.width;
      canvas.height = size.height;
    }
    this.context.imageSmoothingQuality = 'high';
    this.painted = true;
    return size;
  }

  /** Whether a page may read back what it painted: some browsers give noise (resistFingerprinting). */
  isReadable(): boolean {
    const probe = document.createElement('canvas').getContext('2d');
    if (!probe) return false;
    probe.fillStyle = '#123456';
    probe.fillRect(0, 0, 8, 8);
    const { data } = probe.getImageData(0, 0, 8, 8);
    return data.every((value, i) => value === [0x12, 0x34, 0x56, 0xff][i % 4]);
  }

  /** Of the picture that is shown; null before the first. */
  size(): Size | null {
    return this.painted ? { width: this.canvas.width, height: this.canvas.height } : null;
  }

  /** The picture as it is shown, at its own size; null before the first. */
  png(): Promise<Blob | null> {
    if (!this.painted) return Promise.resolve(null);
    return new Promise((resolve) => this.canvas.toBlob(resolve, 'image/png'));
  }
}
