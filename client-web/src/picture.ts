// The canvas: paints bitmaps and saves the picture.

export class Picture {
  private readonly context: CanvasRenderingContext2D;
  private painted = false;

  constructor(private readonly canvas: HTMLCanvasElement) {
    const context = canvas.getContext('2d', { alpha: false });
    if (!context) throw new Error('this browser has no 2D canvas');
    this.context = context;
  }

  paint(bitmap: ImageBitmap): void {
    const { canvas } = this;
    if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
    }
    this.context.drawImage(bitmap, 0, 0);
    this.painted = true;
  }

  /** The picture as it is shown, at its own size; null before the first. */
  png(): Promise<Blob | null> {
    if (!this.painted) return Promise.resolve(null);
    return new Promise((resolve) => this.canvas.toBlob(resolve, 'image/png'));
  }
}

/** Hands a file to the browser's downloads. */
export function download(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  // The download holds the data once it has started, which takes a turn of the event loop or more.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
