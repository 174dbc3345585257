import { create } from '@bufbuild/protobuf';
import { expect, test } from 'vitest';

import { FrameHeaderSchema } from '../../src/gen/froxel/v1/server_pb';
import { LookCosts } from '../../src/stats/look_costs';

const frame = (appliedSeq: bigint, ...us: (number | undefined)[]) =>
  create(FrameHeaderSchema, {
    appliedSeq,
    passes: us.map((gpuUs) => ({ name: 'pass', ...(gpuUs !== undefined && { gpuUs }) })),
  });

test('LookCosts_AreMeansOverFramesOfTheNewestState', () => {
  const costs = new LookCosts();
  for (let i = 0; i < 9; i += 1) costs.painted(frame(1n, 50_000));
  for (let i = 0; i < 4; i += 1) costs.painted(frame(2n, 1_000, 2_000));
  costs.note(['evening'], 2n);
  expect(costs.ofMs('evening')).toBeUndefined(); // too few of it
  costs.painted(frame(2n, 3_000, 5_000));
  costs.note(['evening'], 3n);
  expect(costs.ofMs('evening')).toBeUndefined(); // newer settings are under way
  costs.note(['evening', 'own:mine'], 2n);
  expect(costs.ofMs('evening')).toBe(4);
  expect(costs.ofMs('own:mine')).toBe(4);
  expect(costs.ofMs('noon')).toBeUndefined();
});

test('LookCosts_OfFramesWithoutTimestamps_AreUnknown', () => {
  const costs = new LookCosts();
  for (let i = 0; i < 9; i += 1) costs.painted(frame(1n, 1_000, undefined));
  costs.note(['evening'], 1n);
  expect(costs.ofMs('evening')).toBeUndefined();
});
