// Linear colours, as lights have them, and colours of the screen (IEC 61966-2-1).

import { vec, type Vec } from './vec3';

const encode = (x: number): number =>
  x <= 0.0031308 ? 12.92 * x : 1.055 * Math.pow(x, 1 / 2.4) - 0.055;
const decode = (x: number): number =>
  x <= 0.04045 ? x / 12.92 : Math.pow((x + 0.055) / 1.055, 2.4);

/** "#rrggbb" of a linear colour from 0 to 1. */
export function displayColor({ x, y, z }: Vec): string {
  const byte = (part: number): string =>
    Math.round(encode(Math.max(0, Math.min(1, part))) * 255)
      .toString(16)
      .padStart(2, '0');
  return `#${byte(x)}${byte(y)}${byte(z)}`;
}

export function linearColor(display: string): Vec {
  const part = (at: number): number => decode(parseInt(display.slice(at, at + 2), 16) / 255);
  return vec(part(1), part(3), part(5));
}
