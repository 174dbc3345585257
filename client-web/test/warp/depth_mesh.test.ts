import { create } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { DepthMeshHeaderSchema, type DepthMeshHeader } from '../../src/gen/froxel/v1/server_pb';
import { decodeDepthMesh, verticesAlong } from '../../src/warp/depth_mesh';

const bytesOf = (hex: string): Uint8Array =>
  new Uint8Array(hex.match(/../g)?.map((pair) => parseInt(pair, 16)) ?? []);

function header(change: Partial<DepthMeshHeader> = {}): DepthMeshHeader {
  return create(DepthMeshHeaderSchema, { number: 3n, columns: 3, rows: 2, bits: 8, nearestPerM: 0.5, cellPx: 8, ...change });
}

describe('decodeDepthMesh', () => {
  it('ExampleOfTheProtocol_IsReadAsItSays', () => {
    const mesh = decodeDepthMesh(header(), bytesOf('108824e13f11fd07'));
    expect([...mesh.steps]).toEqual([128, 128, 128, 255, 255, 0]);
    expect(mesh.perStep * 255).toBeCloseTo(0.5, 12);
    expect(mesh.medianPerM).toBeCloseTo((0.5 * 128) / 255, 12);
    expect(mesh.number).toBe(3n);
  });

  it('Nothing_IsNowhere', () => {
    const mesh = decodeDepthMesh(header({ nearestPerM: 0 }), bytesOf('06'));
    expect([mesh.perStep, mesh.medianPerM, ...mesh.steps]).toEqual([0, 0, 0, 0, 0, 0, 0, 0]);
  });

  it.each([
    ['sides', { columns: 0 }, '06', /0x2 vertices; expected 1 to 513/],
    ['a huge side', { rows: 514 }, '06', /3x514 vertices; expected/],
    ['close vertices', { cellPx: 7 }, '06', /they are 7 pixels apart; expected 8 to 64/],
    ['far vertices', { cellPx: 65 }, '06', /they are 65 pixels apart/],
    ['few bits', { bits: 5 }, '06', /it has 5 bits; expected 6 to 12/],
    ['many bits', { bits: 13 }, '06', /it has 13 bits/],
    ['no number', { nearestPerM: NaN }, '06', /nearest inverse distance is NaN/],
    ['an endless number', { nearestPerM: Infinity }, '06', /is Infinity/],
    ['a negative number', { nearestPerM: -1 }, '06', /is -1/],
    ['no bytes', {}, '', /a run at vertex 0 ends beyond/],
    ['too many vertices', {}, '07', /a run at vertex 0 ends beyond/],
    ['an empty run', {}, '00', /a run at vertex 0 ends beyond/],
    ['too few vertices', {}, '05', /a run at vertex 5 ends beyond/],
    ['a run without end', {}, '8888888888', /a run at vertex 0 ends beyond/],
    ['a step below 0', {}, '1501', /vertex 5 is at step -1 of 255/],
    ['a missing step', {}, '15', /its bytes end at vertex 5/],
    ['more bytes', {}, '0600', /bytes follow its last vertex/],
  ] as const)('With_%s_IsRefused', (_, change, hex, problem) => {
    expect(() => decodeDepthMesh(header(change), bytesOf(hex))).toThrow(problem);
  });

  it('AnyBytes_AreReadOrRefused', () => {
    let seed = 1;
    const random = (): number => (seed = (seed * 48271) % 2147483647);
    let read = 0;
    for (let i = 0; i < 20_000; i += 1) {
      const bytes = Uint8Array.from({ length: random() % 12 }, () => random() % 256);
      try {
        const mesh = decodeDepthMesh(header(), bytes);
        expect(mesh.steps.every((step) => step <= 255)).toBe(true);
        read += 1;
      } catch (error) {
        expect(String(error)).toMatch(/depth mesh of 3x2 vertices/);
      }
    }
    expect(read).toBeGreaterThan(0);
  });

  it('Vertices_AreAtEverySoManiethPixelAndTheLast', () => {
    expect([1, 2, 8, 9, 10, 1280, 720].map((side) => verticesAlong(side, 8))).toEqual([1, 2, 2, 2, 3, 161, 91]);
    expect(verticesAlong(1280, 16)).toBe(81);
  });
});
