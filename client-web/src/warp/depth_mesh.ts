// The code of a depth mesh, as protocol/README.md has it ("Depth").

import type { DepthMeshHeader } from '../gen/froxel/v1/server_pb';

const kMinBits = 6;
const kMaxBits = 12;
const kMinCellPx = 8;
const kMaxCellPx = 64;
const kMostSide = 4096 / kMinCellPx + 1; // of the largest picture
const kMostNibbles = 7;

export interface DepthMesh {
  readonly number: bigint;
  readonly columns: number;
  readonly rows: number;
  /** Pixels from a vertex to the next. */
  readonly cellPx: number;
  /** By row: steps of inverse distance, 0 where nothing is. */
  readonly steps: Uint16Array<ArrayBuffer>;
  /** Inverse distance along the view axis that a step adds, in 1/m. */
  readonly perStep: number;
  /** Of the nearest vertex, and of the middle one of those that show something. */
  readonly nearestPerM: number;
  readonly medianPerM: number;
}

export const verticesAlong = (sidePx: number, cellPx: number): number => Math.ceil((sidePx - 1) / cellPx) + 1;

/** A mesh that is not what the protocol says; the text is one line for a person. */
export class DepthMeshError extends Error {}

class Nibbles {
  private at = 0;

  constructor(private readonly bytes: Uint8Array) {}

  /** -1: the bytes end within it, or it is longer than any. */
  number(): number {
    let value = 0;
    for (let i = 0; i < kMostNibbles && this.at < 2 * this.bytes.length; i += 1) {
      const next = this.next();
      value |= (next & 7) << (3 * i);
      if (next < 8) return value;
    }
    return -1;
  }

  /** Whether no more than the nibble that fills the last byte is left. */
  atEnd(): boolean {
    const left = 2 * this.bytes.length - this.at;
    return left === 0 || (left === 1 && this.next() === 0);
  }

  private next(): number {
    const byte = this.bytes[this.at >> 1] ?? 0;
    const nibble = this.at % 2 === 0 ? byte & 15 : byte >> 4;
    this.at += 1;
    return nibble;
  }
}

/** Throws DepthMeshError. */
export function decodeDepthMesh(header: DepthMeshHeader, bytes: Uint8Array): DepthMesh {
  const { number, columns, rows, bits, nearestPerM, cellPx } = header;
  const size = `depth mesh of ${columns}x${rows} vertices`;
  const isSide = (side: number): boolean => side >= 1 && side <= kMostSide;
  if (!isSide(columns) || !isSide(rows)) {
    throw new DepthMeshError(`${size}; expected 1 to ${kMostSide} each`);
  }
  if (cellPx < kMinCellPx || cellPx > kMaxCellPx) {
    throw new DepthMeshError(`${size}: they are ${cellPx} pixels apart; expected ${kMinCellPx} to ${kMaxCellPx}`);
  }
  if (bits < kMinBits || bits > kMaxBits) {
    throw new DepthMeshError(`${size}: it has ${bits} bits; expected ${kMinBits} to ${kMaxBits}`);
  }
  if (!(nearestPerM >= 0 && nearestPerM < Infinity)) {
    throw new DepthMeshError(`${size}: its nearest inverse distance is ${nearestPerM}`);
  }
  const top = 2 ** bits - 1;
  const steps = new Uint16Array(columns * rows);
  const problem = decodeSteps(new Nibbles(bytes), columns, top, steps);
  if (problem) throw new DepthMeshError(`${size}: ${problem}`);
  const perStep = nearestPerM / top;
  return { number, columns, rows, cellPx, steps, perStep, nearestPerM, medianPerM: median(steps) * perStep };
}

const kSamples = 512;

/** Of those that are not 0, about; 0: none is. */
function median(steps: Uint16Array): number {
  const every = Math.max(1, Math.floor(steps.length / kSamples));
  const some = steps.filter((step, i) => step > 0 && i % every === 0).sort();
  return some[some.length >> 1] ?? 0;
}

/** Fills `steps`, or returns what is wrong. */
function decodeSteps(from: Nibbles, columns: number, top: number, steps: Uint16Array): string | null {
  for (let i = 0; i < steps.length; ) {
    const zeros = from.number();
    const others = from.number();
    const count = zeros + others;
    if (zeros < 0 || others < 0 || count === 0 || count > steps.length - i) {
      return `a run at vertex ${i} ends beyond the last one`;
    }
    const firstOther = i + zeros;
    for (const end = i + count; i < end; i += 1) {
      const folded = i < firstOther ? 0 : from.number();
      if (folded < 0) return `its bytes end at vertex ${i}`;
      const difference = folded % 2 === 0 ? folded / 2 : -(folded + 1) / 2;
      const step = predicted(steps, i, columns, top) + difference;
      if (step < 0 || step > top) return `vertex ${i} is at step ${step} of ${top}`;
      steps[i] = step;
    }
  }
  return from.atEnd() ? null : 'bytes follow its last vertex';
}

/** What the vertices before say of one. */
function predicted(steps: Uint16Array, i: number, columns: number, top: number): number {
  const at = (index: number): number => steps[index] ?? 0;
  const firstColumn = i % columns === 0;
  if (i < columns) return firstColumn ? 0 : at(i - 1);
  const above = at(i - columns);
  if (firstColumn) return above;
  return Math.max(0, Math.min(top, at(i - 1) + above - at(i - columns - 1)));
}
