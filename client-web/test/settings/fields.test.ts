import { describe, expect, it } from 'vitest';

import { BloomKind, EnvironmentLight, Renderer } from '../../src/gen/froxel/v1/common_pb';
import { fieldsOf, isInUse, kAllFields, patchFor } from '../../src/settings/fields';
import { valueOf } from '../../src/settings/settings';
import { sampleSettings } from '../sample';

describe('fields', () => {
  it('Fields_HaveEachNameOnceAndAValueInTheSettings', () => {
    const settings = sampleSettings();
    expect(new Set(kAllFields.map(({ name }) => name)).size).toBe(kAllFields.length);
    for (const field of kAllFields) expect(valueOf(settings, field)).toBeDefined();
  });

  it('Sections_HaveEveryFieldOnce', () => {
    const sections = [
      'camera',
      'rendering',
      'exposure',
      'effects',
      'lights',
      'animation',
      'materials',
      'environment',
      'clusters',
      'debug',
      'stream',
    ] as const;
    const names = sections.flatMap((section) => fieldsOf(section).map(({ name }) => name));
    expect(names.sort()).toEqual(kAllFields.map(({ name }) => name).sort());
  });

  it.each([
    ['bloom_knee', { bloom: BloomKind.MIP_CHAIN }],
    ['fog_albedo', { fogDensity: 1 }],
    ['outline_width', { renderer: Renderer.TOON_COMPUTE }],
    ['shadow_size', { shadowLights: 1 }],
    ['environment_strength', { environment: EnvironmentLight.STUDIO }],
    ['environment_blur', { environment: EnvironmentLight.STUDIO, environmentBackground: true }],
    ['grid.x', { gridAutomatic: false }],
  ])('Field_%s_IsInUseOnlyWithWhatItBelongsTo', (name, change) => {
    const field = kAllFields.find((candidate) => candidate.name === name);
    if (!field) throw new Error(`no field ${name}`);
    expect(isInUse(field, sampleSettings())).toBe(false);
    expect(isInUse(field, sampleSettings(change))).toBe(true);
  });

  it('SideOfTheGrid_MakesItOneByHand', () => {
    const field = kAllFields.find(({ key }) => key === 'gridY');
    if (!field) throw new Error('no field for the tiles');
    expect(patchFor(field, 7)).toEqual({ gridY: 7, gridAutomatic: false });
  });

  it('AngleOfView_MakesTheProjectionPerspective', () => {
    const field = kAllFields.find(({ key }) => key === 'fovDeg');
    if (!field) throw new Error('no field for the angle');
    expect(patchFor(field, 60)).toEqual({ fovDeg: 60, orthographic: false });
  });
});
