/** Of a picture or a canvas, in pixels. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

export interface Rect extends Size {
  readonly left: number;
  readonly top: number;
}

/** Where a picture of that size is in its box, as `object-fit: contain` puts it. */
export function containedIn(box: Rect, picture: Size): Rect {
  const factor = Math.min(box.width / picture.width, box.height / picture.height);
  const [width, height] = [picture.width * factor, picture.height * factor];
  return {
    left: box.left + (box.width - width) / 2,
    top: box.top + (box.height - height) / 2,
    width,
    height,
  };
}

export const sizeText = ({ width, height }: Size): string => `${width} × ${height}`;
