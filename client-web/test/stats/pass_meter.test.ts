import { describe, expect, it } from 'vitest';

import { PassMeter, sumOf } from '../../src/stats/pass_meter';
import { colorOfPass } from '../../src/stats/pass_stack';
import { frameHeader } from '../fakes';

const frame = (...passes: [name: string, gpuUs?: number][]): ReturnType<typeof frameHeader> =>
  frameHeader({
    passes: passes.map(([name, gpuUs]) => (gpuUs === undefined ? { name } : { name, gpuUs })),
  });

describe('PassMeter', () => {
  it('Shares_AreMeansInOrder_AndAddUpToOne', () => {
    const meter = new PassMeter();
    expect(meter.shares()).toEqual([]);
    meter.add(frame(['gbuffer', 1000], ['lighting', 2000]));
    meter.add(frame(['gbuffer', 3000], ['lighting', 4000]));
    expect(meter.shares()).toEqual([
      { name: 'gbuffer', ms: 2, share: 0.4 },
      { name: 'lighting', ms: 3, share: 0.6 },
    ]);
  });

  it('OtherPasses_StartAnew', () => {
    const meter = new PassMeter();
    meter.add(frame(['gbuffer', 1000]));
    meter.add(frame(['forward', 500]));
    expect(meter.shares()).toEqual([{ name: 'forward', ms: 0.5, share: 1 }]);
  });

  it('Frames_LongAgo_AreForgotten', () => {
    const meter = new PassMeter();
    for (let i = 0; i < 30; i += 1) meter.add(frame(['forward', 1000]));
    for (let i = 0; i < 30; i += 1) meter.add(frame(['forward', 4000]));
    expect(meter.shares()[0]?.ms).toBe(4);
  });

  it('PassesThatTakeNoTime_HaveNoShare', () => {
    const meter = new PassMeter();
    meter.add(frame(['forward', 0]));
    expect(meter.shares()[0]?.share).toBe(0);
  });
});

describe('PassMeter of a driver without timestamps', () => {
  it('TimeOfAPass_IsUnknown_AndSoIsEveryShare', () => {
    const meter = new PassMeter();
    meter.add(frame(['gbuffer', 1000], ['lighting']));
    expect(meter.shares()).toEqual([
      { name: 'gbuffer', ms: 1, share: null },
      { name: 'lighting', ms: null, share: null },
    ]);
    expect(sumOf(meter.shares().map(({ ms }) => ms))).toBeNull();
  });

  it('TimeOfNothing_IsKnown', () => {
    const meter = new PassMeter();
    meter.add(frame(['gbuffer', 0], ['lighting', 500]));
    expect(meter.shares()[0]).toEqual({ name: 'gbuffer', ms: 0, share: 0 });
  });
});

describe('colorOfPass', () => {
  it('PassesOfAFrame_HaveColoursOfTheirOwn', () => {
    const names = ['assign_count', 'assign_scan', 'assign_fill', 'assign_order', 'shadows', 'cull', 'raster_meshlets'];
    names.push('raster_blocks', 'raster_unpack', 'resolve', 'gbuffer', 'lighting', 'layers', 'transparent', 'bloom');
    names.push('tonemap', 'fxaa', 'readback', 'depth_prepass', 'forward');
    expect(new Set(names.map(colorOfPass)).size).toBe(names.length);
  });
});
