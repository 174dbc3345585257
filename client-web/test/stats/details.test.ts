import { create } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { FrameDetailsSchema } from '../../src/gen/froxel/v1/server_pb';
import {
  exposureText,
  gridRows,
  listRows,
  memoryRows,
  peelText,
  shadowText,
  surfacesText,
} from '../../src/stats/details';
import { frameHeader } from '../fakes';

const valueOf = (rows: { name: string; value: string }[], name: string): string | undefined =>
  rows.find((row) => row.name === name)?.value;

describe('details', () => {
  it('Lists_WithoutCountedPairs_SayNothingOfThem', () => {
    const rows = listRows(frameHeader({ listEntries: 5000n, listBytes: 20_000n, listEmpty: 7 }));
    expect(valueOf(rows, 'Loop over')).toBe('lists');
    expect(valueOf(rows, 'List entries')).toBe('5\u2009000');
    expect(valueOf(rows, '… empty')).toBe('7');
    expect(valueOf(rows, 'Lists in memory')).toBe('20.0 kB');
    expect(valueOf(rows, 'Pairs evaluated')).toBeUndefined();
  });

  it('Pairs_Counted_HaveTheirShare', () => {
    const rows = listRows(
      frameHeader({ allLights: true, pairs: { evaluated: 4_000_000_000n, contributing: 1_000_000_000n } }),
    );
    expect(valueOf(rows, 'Loop over')).toBe('all lights');
    expect(valueOf(rows, '… contributing')).toContain('25.0 %');
  });

  it('Grid_Chosen_HasSizeTilesAndDepth', () => {
    const grid = { x: 30, y: 17, z: 32, tileWidthPx: 64, tileHeightPx: 60, nearM: 0.123456, farM: 40 };
    const rows = gridRows(frameHeader({ grid: { ...grid, automatic: true } }));
    expect(rows).toEqual([
      { name: 'Grid, automatic', value: '30 × 17 × 32' },
      { name: 'Tile', value: '64 × 60 px' },
      { name: 'Depth', value: '0.123 to 40 m' },
    ]);
    expect(gridRows(frameHeader({ grid }))[0]?.name).toBe('Grid, by hand');
    expect(gridRows(frameHeader({}))).toEqual([]);
  });

  it('PeeledLayers_AreToldWithPixelsThatHaveMore', () => {
    expect(peelText(frameHeader({}))).toBe('–');
    expect(peelText(frameHeader({ peel: { layers: 4, overflowPixels: 1200n } }))).toBe(
      '4 · 1\u2009200 px',
    );
  });

  it('ShadowMaps_AreToldWithTheirLights', () => {
    expect(shadowText(frameHeader({}))).toBe('–');
    expect(shadowText(frameHeader({ shadows: { lights: 2, maps: 7 } }))).toBe('2 · 7');
    expect(shadowText(frameHeader({ shadows: { lights: 2, maps: 7, mapsKept: 6 } }))).toBe(
      '2 · 7, 6 kept',
    );
  });

  it('SurfacesThatRest_AreToldAsKept', () => {
    expect(surfacesText(frameHeader({}))).toBe('drawn');
    expect(surfacesText(frameHeader({ surfacesKept: true }))).toBe('kept');
  });

  it('Exposure_Metered_IsToldInStops', () => {
    expect(exposureText(frameHeader({}))).toBe('fixed');
    expect(exposureText(frameHeader({ meteredEv: 0 }))).toBe('+0.0 EV');
    expect(exposureText(frameHeader({ meteredEv: 2.26 }))).toBe('+2.3 EV');
    expect(exposureText(frameHeader({ meteredEv: -10 }))).toBe('−10.0 EV');
  });

  it('Memory_IsLargestFirstWithItsSum', () => {
    const memory = [
      { purpose: 'lists', bytes: 1000n },
      { purpose: 'textures', bytes: 6_000_000n },
    ];
    expect(memoryRows(create(FrameDetailsSchema, { memory }))).toEqual([
      { name: 'textures', value: '6.0 MB' },
      { name: 'lists', value: '1.0 kB' },
      { name: 'Together', value: '6.0 MB' },
    ]);
  });
});
