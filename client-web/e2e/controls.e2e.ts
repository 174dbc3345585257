// Every control of the panel changes the session's state, and where it should, the picture.

import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { Renderer } from '../src/gen/froxel/v1/common_pb';
import type { Field, NumberField } from '../src/settings/field';
import { choicesFor, isGridSide, kAllFields } from '../src/settings/fields';
import { settingsOf, valueOf, type Settings } from '../src/settings/settings';
import { launch } from './chromium';
import { startServer, type Server } from './server';
import { difference, until, Viewer } from './viewer';

/**
 * Values for numbers that show in a still picture, in an order in which they do, and for those that
 * this depends on or that cost much; with whether they show. The others' come from their ranges.
 */
const kGiven: Readonly<Record<string, readonly [number, boolean]>> = {
  fov_deg: [75, true],
  'lens_shift.x': [0.5, true],
  'lens_shift.y': [-0.25, true],
  exposure: [2, true],
  bloom_threshold: [0.25, false],
  bloom_knee: [1, false],
  bloom_strength: [1, true],
  bloom_radius: [0.05, true],
  fog_density: [0.25, true],
  fog_height_falloff: [2, true],
  fog_base_height: [1.5, true],
  fog_anisotropy: [0.5, true],
  shadow_lights: [4, false],
  outline_strength: [1, true],
  outline_width: [0.01, true],
  toon_bands: [5, true],
  toon_rim: [3, true],
  toon_rim_width: [0.9, true],
  lights: [300, true],
  light_radius: [4, true],
  light_intensity: [3, true],
  scene_light_intensity: [0.25, true],
  light_cutoff: [0.01, true],
  seed: [12_345_678, true],
  ambient: [5, true],
  list_cap: [1, true],
  target_fps: [1, false], // which every picture meets: none is scaled
};

/** The hall has no animations, material variants or coarser levels, and so no controls of them. */
const kShownFields = kAllFields.filter(
  ({ name }) => !name.startsWith('animation') && name !== 'material_variant' && name !== 'geometry_error',
);
const kNumbers: readonly NumberField[] = kShownFields.filter((field) => field.kind === 'number');
const kGivenNumbers = Object.keys(kGiven).map((name) => {
  const field = kNumbers.find((candidate) => candidate.name === name);
  if (!field) throw new Error(`no number ${name}`);
  return field;
});
const kOtherNumbers = kNumbers.filter((field) => !kGivenNumbers.includes(field));

/** What must be chosen so that fields of a prefix can be set. */
const kNeeded = {
  peel_: { name: 'transparency', label: 'peeled', usual: 'sorted' },
  bloom_: { name: 'bloom', label: 'mip chain', usual: 'none' },
  outline_: { name: 'renderer', label: 'toon fragment', usual: 'clustered deferred' },
  toon_: { name: 'renderer', label: 'toon fragment', usual: 'clustered deferred' },
  environment_: { name: 'environment', label: 'studio', usual: 'off' },
} as const;
const neededFor = (name: string) => Object.entries(kNeeded).find(([prefix]) => name.startsWith(prefix))?.[1];

let server: Server;
let browser: Browser;
let viewer: Viewer;

beforeAll(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
  const url = `${server.url}#size=320x180&animate=0&lights=100&renderer=clustered_deferred`;
  viewer = await Viewer.open(browser, url);
  await viewer.picture();
  await viewer.openPanel();
});
afterAll(async () => {
  expect(viewer.complaints).toEqual([]);
  await browser.close();
  expect(await server.stop()).toBe(0);
});

const told = (): Settings | null => (viewer.state ? settingsOf(viewer.state, null, []) : null);

const disabled = (name: string): Promise<true> =>
  until(`${name} is disabled`, async () =>
    ((await viewer.control(name).getAttribute('class')) ?? '').includes('lil-disabled') ? true : null,
  );

async function setSwitch(name: string, on: boolean): Promise<void> {
  await viewer.control(name).locator('input').setChecked(on);
  await viewer.settled();
}

/** Another value than now, from the range that the server told. */
function otherValue(field: NumberField): number {
  const ranges = viewer.received.flatMap(({ body }) =>
    body.case === 'welcome' ? body.value.ranges : [],
  );
  const range = ranges.find((candidate) => candidate.field === field.name);
  const now = told();
  if (!range || !now) throw new Error(`no range of ${field.name}`);
  const part = (share: number): number => {
    const value = range.min + (range.max - range.min) * share;
    return field.integer ? Math.round(value) : value;
  };
  return part(0.25) === valueOf(now, field) ? part(0.5) : part(0.25);
}

async function expectState(field: Field, value: number | boolean): Promise<void> {
  await viewer.stateWith(`${field.name} = ${String(value)}`, (state) => {
    const now = valueOf(settingsOf(state, null, []), field);
    return typeof now === 'number' && typeof value === 'number'
      ? Math.abs(now - value) <= 1e-6 * Math.abs(value)
      : now === value;
  });
}

describe('numbers', () => {
  for (const field of [...kGivenNumbers, ...kOtherNumbers]) {
    it(`Control_${field.name}_SetsIt`, async () => {
      const [value, visible] = kGiven[field.name] ?? [otherValue(field), false];
      if (isGridSide(field)) await setSwitch('grid.auto', false);
      const needed = neededFor(field.name);
      if (needed) await viewer.choose(needed.name, needed.label);
      if (field.name === 'environment_blur') await setSwitch('environment_background', true);
      const before = await viewer.settled();
      await viewer.type(field.name, value);
      await expectState(field, value);
      if (visible) await viewer.changed(field.name, before);
      if (field.name === 'environment_blur') await setSwitch('environment_background', false);
      if (needed) await viewer.choose(needed.name, needed.usual);
      // Capped, pictures depend on the grid.
      if (field.name === 'list_cap') await viewer.type(field.name, 0);
    });
  }

  it('Slider_ByKeyboard_SetsItsNumberToo', async () => {
    const before = told()?.exposure ?? 0;
    await viewer.control('exposure').locator('input[type=range]').press('ArrowLeft');
    const state = await viewer.stateWith('a lower exposure', ({ exposure }) => exposure < before);
    const shown = await viewer.control('exposure').locator('input:not([type=range])').inputValue();
    expect(Number(shown)).toBeCloseTo(state.exposure, 4);
  });
});

describe('choices', () => {
  for (const field of kShownFields) {
    if (field.kind !== 'choice') continue;
    it(`Control_${field.name}_TakesEveryChoice`, async () => {
      // The server has no panorama to show.
      const choices = choicesFor(field).filter(({ name }) => field.name !== 'environment' || name !== 'file');
      for (const { name, value } of [...choices.slice(1), ...choices.slice(0, 1)]) {
        if (field.name !== 'renderer') await viewer.choose('renderer', 'clustered deferred');
        // Else there is no second target to show.
        if (field.name === 'debug_view') await viewer.choose('gbuffer_position', 'fp32');
        await viewer.choose(field.name, name.replaceAll('_', ' '));
        await expectState(field, value);
      }
    });
  }

  it('Renderer_Toon_ChangesThePicture', async () => {
    await viewer.choose('renderer', 'clustered deferred');
    const before = await viewer.settled();
    await viewer.choose('renderer', 'toon fragment');
    await viewer.changed('toon fragment', before);
  });

  it('FieldsOfWhatIsOff_CannotBeSet', async () => {
    await viewer.choose('renderer', 'clustered deferred');
    await viewer.choose('bloom', 'none');
    for (const name of ['bloom_radius', 'outline_strength']) await disabled(name);
  });

  it('GbufferOfAForwardRenderer_CannotBeChosen', async () => {
    await viewer.choose('renderer', 'naive');
    await viewer.stateWith('naive', ({ renderer }) => renderer === Renderer.NAIVE);
    for (const name of ['gbuffer_normal', 'gbuffer_position']) await disabled(name);
    await viewer.choose('renderer', 'clustered deferred');
  });

  it('Shading_Lambert_ChangesThePicture', async () => {
    const before = await viewer.settled();
    await viewer.choose('shading', 'lambert');
    await viewer.changed('lambert', before);
    await viewer.choose('shading', 'pbr');
  });

  it('LightLoopGridAndLaw_NeverChangeThePicture', async () => {
    const before = await viewer.settled();
    for (const [name, label] of [
      ['light_loop', 'all lights'],
      ['light_loop', 'lists'],
      ['grid_law', 'hyperbolic'],
      ['grid_law', 'linear'],
    ] as const) {
      await viewer.choose(name, label);
      expect(difference(await viewer.settled(), before)).toBe(0);
    }
    await viewer.choose('light_loop', 'auto');
    await viewer.choose('grid_law', 'logarithmic');
  });
});

describe('debug views', () => {
  it('HeatMap_ChangesThePicture_AndHasALegend', async () => {
    await viewer.choose('debug_view', 'none');
    const before = await viewer.settled();
    const legend = viewer.page.locator('#legend');
    await until('no legend', async () => !(await legend.isVisible()));
    await viewer.choose('debug_view', 'listed lights');
    await viewer.type('debug_scale_max', 40);
    await viewer.changed('listed lights', before);
    await until('the scale', async () => (await legend.locator('#legend-max').textContent()) === '40 lights');
    await viewer.screenshot('debug');
    await viewer.choose('debug_view', 'normal');
    await until('no scale', async () => !(await legend.locator('#legend-scale').isVisible()));
    expect(await legend.locator('#legend-words').textContent()).toContain('normal');
    await viewer.choose('debug_view', 'none');
    await until('no legend', async () => !(await legend.isVisible()));
    expect(difference(await viewer.settled(), before)).toBe(0);
  });
});

describe('switches', () => {
  for (const field of kShownFields) {
    if (field.kind !== 'boolean') continue;
    it(`Control_${field.name}_GoesOnAndOff`, async () => {
      const needed = neededFor(field.name);
      if (needed) await viewer.choose(needed.name, needed.label);
      const now = told();
      const before = now !== null && valueOf(now, field);
      for (const value of [!before, before]) {
        await viewer.control(field.name).locator('input').click();
        await expectState(field, value);
      }
      if (needed) await viewer.choose(needed.name, needed.usual);
    });
  }

  it('Animate_MovesThePicture', async () => {
    await viewer.control('animate').locator('input').click();
    await viewer.changed('animation', await viewer.thumbnail());
    await viewer.control('animate').locator('input').click();
    await viewer.stateWith('no animation', ({ lightAnimate }) => !lightAnimate);
  });
});

describe('the grid', () => {
  it('Automatic_ShowsTheOneInUseAndLocksTheSides', async () => {
    await setSwitch('grid.auto', true);
    await viewer.settled();
    const { grid } = viewer.lastFrame ?? {};
    expect(grid?.automatic).toBe(true);
    expect(grid?.why).not.toBe('');
    const shown = viewer.control('grid.in_use').locator('input');
    const text = `${grid?.x} × ${grid?.y} × ${grid?.z}`;
    await until(text, async () => (await shown.inputValue()) === text);
    await disabled('grid.x');
  });

  it('ByHand_IsTheOneInUse', async () => {
    await setSwitch('grid.auto', false);
    await viewer.type('grid.x', 7);
    await viewer.stateWith('7 tiles across', ({ grid }) => grid?.x === 7);
    await until('them in a frame', () => viewer.lastFrame?.grid?.x === 7);
    await setSwitch('grid.auto', true);
  });
});

describe('others', () => {
  it('Tooltip_HasTheServersWords', async () => {
    await until('what bloom costs', async () =>
      ((await viewer.control('bloom').getAttribute('title')) ?? '').includes('Costs: '),
    );
  });

  it('SceneCamera_IsGoneTo', async () => {
    const names = viewer.received.flatMap(({ body }) =>
      body.case === 'welcome' ? (body.value.scene?.cameras ?? []) : [],
    );
    const name = names[1];
    if (name === undefined) throw new Error('the scene has no second camera');
    const before = await viewer.settled();
    const eye = told()?.eye;
    await viewer.choose('scene_camera', name);
    await viewer.stateWith(name, (state) => state.eye?.x !== eye?.x || state.eye?.z !== eye?.z);
    await viewer.changed(name, before);
  });

  it('LightBox_IsSetAndTakenAway', async () => {
    await viewer.type('light_box.max.x', 1.5);
    await viewer.stateWith('a box to x = 1.5', ({ lightBox }) => lightBox?.max?.x === 1.5);
    await viewer.control('light_box.clear').locator('button').click();
    await viewer.stateWith('the scene’s box', ({ lightBox }) => lightBox?.max?.x !== 1.5);
  });

  it.each(['toonFragment', 'toonCompute'] as const)('Ramp_%s_IsDraggedAndTyped', async (key) => {
    const ramp = viewer.page.locator('.ramp').nth(key === 'toonFragment' ? 0 : 1);
    await ramp.scrollIntoViewIfNeeded();
    const points = viewer.state?.[key]?.points ?? [];
    const circle = await ramp.locator('circle').nth(1).boundingBox();
    if (!circle) throw new Error('the ramp shows no points');
    const { mouse } = viewer.page;
    await mouse.move(circle.x + circle.width / 2, circle.y + circle.height / 2);
    await mouse.down();
    await mouse.move(circle.x + circle.width / 2, circle.y - 12, { steps: 3 });
    await mouse.up();
    await viewer.stateWith('a higher point', (state) => {
      return (state[key]?.points[1]?.y ?? 0) > (points[1]?.y ?? 1) + 0.05;
    });
    await ramp.locator('input').nth(2).fill('0.5');
    await ramp.locator('input').nth(2).press('Enter');
    await viewer.stateWith('a slope', (state) => state[key]?.points[1]?.slope === 0.5);
    await ramp.getByTitle('Remove this point').click();
    await viewer.stateWith('a point less', (state) => {
      return state[key]?.points.length === points.length - 1;
    });
    await ramp.getByTitle('Add a point after this one').click();
    await viewer.stateWith('a point more', (state) => state[key]?.points.length === points.length);
  });

  it('Size_ByPresetByNumberAndByTheWindow', async () => {
    await viewer.choose('size', '640×360');
    await viewer.stateWith('640 × 360', ({ width, height }) => width === 640 && height === 360);
    await viewer.choose('size', 'custom');
    await viewer.type('width', 201);
    await viewer.type('height', 99);
    await viewer.stateWith('201 × 99', ({ width, height }) => width === 201 && height === 99);
    await viewer.choose('size', 'window');
    await viewer.type('size.scale', 0.25);
    await viewer.stateWith('a quarter', ({ width, height }) => width === 320 && height === 180);
  });

  it('Scale_StaysAsTyped_WhileStatesArrive', async () => {
    await viewer.choose('size', 'window');
    const scale = viewer.control('size.scale').locator('input:not([type=range])');
    await scale.fill('0.5');
    const animated = told()?.animate ?? false;
    const elsewhere = viewer.control('animate').locator('input');
    for (const animate of [!animated, animated]) {
      await elsewhere.evaluate((input: HTMLInputElement) => input.click()); // the focus stays
      await viewer.stateWith('another one', ({ lightAnimate }) => lightAnimate === animate);
    }
    await scale.press('Enter');
    await viewer.stateWith('a half', ({ width, height }) => width === 640 && height === 360);
  });

  it('Reset_GoesBackToTheServersState', async () => {
    await viewer.type('exposure', 7);
    await viewer.stateWith('exposure 7', ({ exposure }) => exposure === 7);
    await viewer.page.getByRole('button', { name: 'Back to the server’s defaults' }).click();
    await viewer.stateWith('exposure 1', ({ exposure }) => exposure === 1);
  });
});
