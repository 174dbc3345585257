import { create } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { vec } from '../../src/core/vec3';
import { LightKind, PlacedLightsSchema } from '../../src/gen/froxel/v1/common_pb';
import { lightSetOf, lightSetText } from '../../src/settings/light_set';
import {
  freeId,
  kNewLight,
  placedAfter,
  placedChanges,
  withLight,
  withoutLight,
  type PlacedLight,
  type PlacedLights,
} from '../../src/settings/placed_lights';

const light = (id: number, change: Partial<PlacedLight> = {}): PlacedLight => ({
  ...kNewLight,
  id,
  position: vec(id, 0, 0),
  ...change,
});

/** What a server would make of the commands. */
function told(from: PlacedLights, to: PlacedLights): PlacedLights {
  return placedChanges(from, to).reduce(
    (lights, change) => placedAfter(lights, create(PlacedLightsSchema, change)),
    from,
  );
}

describe('a light that stands for another', () => {
  it('Index_GoesToTheServerAndIntoAFileAndBack', () => {
    const lights = [light(1, { replacesSeeded: 0 }), light(2, { replacesScene: 7 }), light(3)];
    expect(told([], lights)).toEqual(lights);
    expect(lightSetOf(lightSetText(lights))).toEqual(lights);
    for (const now of [[light(1)], [light(1, { replacesScene: 3 })], [light(1), light(2)]]) {
      expect(told(lights, now)).toEqual(now);
    }
    expect(placedChanges([], [light(3)])[0]?.lights?.[0]).not.toHaveProperty('replacesSeeded');
  });
});

describe('placedChanges', () => {
  it('NothingChanged_IsNoCommand', () => {
    const lights = [light(1)];
    expect(placedChanges(lights, lights)).toEqual([]);
    expect(placedChanges(lights, [light(1)])).toEqual([]);
  });

  it('OneMoved_IsItAlone', () => {
    const to = [light(1), light(2, { position: vec(0, 5, 0) })];
    const [change, ...more] = placedChanges([light(1), light(2)], to);
    expect(more).toEqual([]);
    expect(change?.lights?.map(({ id }) => id)).toEqual([2]);
    expect(change?.remove).toBeUndefined();
  });

  it('AddedRemovedAndChanged_ComeOutAsWanted', () => {
    const from = [light(1), light(2), light(5)];
    const to = [light(2, { kind: LightKind.SPOT }), light(5), light(7)];
    expect(told(from, to)).toEqual(to);
    expect(told(from, [])).toEqual([]);
    expect(placedChanges(from, [])).toEqual([{ clear: true }]);
  });

  it('LargeSet_IsSplit', () => {
    const to = Array.from({ length: 600 }, (_, i) => light(i + 1));
    const changes = placedChanges([light(9000)], to);
    expect(changes.map(({ lights }) => lights?.length)).toEqual([256, 256, 88]);
    expect(changes.map(({ clear }) => clear ?? false)).toEqual([true, false, false]);
    expect(told([light(9000)], to)).toEqual(to);
  });
});

describe('light sets', () => {
  it('SavedAndLoaded_IsTheSame', () => {
    const lights = [light(3, { color: vec(0.25, 0.5, 1), kind: LightKind.SPOT, radius: 7 }), light(8)];
    expect(lightSetOf(lightSetText(lights))).toEqual(lights);
    expect(JSON.parse(lightSetText(lights))).toHaveProperty(['lights', 0, 'kind'], 'LIGHT_KIND_SPOT');
  });

  it.each([
    ['{', /JSON/],
    ['{"lights":3}', /lights/],
    ['{"clear":true}', /only lights/],
    ['{"lights":[{"position":{}}]}', /id 0/],
    ['{"lights":[{"id":1,"position":{}},{"id":1,"position":{}}]}', /appears twice/],
    ['{"lights":[{"id":1}]}', /no position/],
  ])('NoSet_%s_Throws', (text, why) => {
    expect(() => lightSetOf(text)).toThrow(why);
  });

  it('AbsentFields_AreANewLights', () => {
    expect(lightSetOf('{"lights":[{"id":4,"position":{"x":4}}]}')).toEqual([light(4)]);
  });
});

describe('lists', () => {
  it('WithAndWithout_KeepTheOrder', () => {
    expect(withLight([light(1), light(3)], light(2)).map(({ id }) => id)).toEqual([1, 2, 3]);
    expect(withLight([light(1)], light(1, { radius: 9 }))).toEqual([light(1, { radius: 9 })]);
    expect(withoutLight([light(1), light(2)], 1)).toEqual([light(2)]);
    expect(freeId([])).toBe(1);
    expect(freeId([light(1), light(6)])).toBe(7);
  });
});
