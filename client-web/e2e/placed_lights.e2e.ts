// Lights placed in the page: added, coloured, dragged by their handles, saved, loaded, deleted.

import { readFileSync } from 'node:fs';

import type { Locator } from 'playwright-core';
import { expect, it } from 'vitest';

import { LightKind } from '../src/gen/froxel/v1/common_pb';
import { placedAfter, type PlacedLights } from '../src/settings/placed_lights';
import { usePages } from './pages';
import { difference, until, type Viewer } from './viewer';

const kStill = '#size=640x360&lights=0&refine=none&renderer=forward_plus';

const pages = usePages();

/** What the server has told of placed lights. */
function told(viewer: Viewer): PlacedLights {
  return viewer.received.reduce<PlacedLights>((lights, { body }) => {
    if (body.case === 'welcome') return placedAfter([], body.value.placedLights);
    return body.case === 'state' ? placedAfter(lights, body.value.placedLights) : lights;
  }, []);
}

const count = (viewer: Viewer, wanted: number): Promise<true> =>
  until(`${wanted} placed lights`, () => told(viewer).length === wanted);

/** The middle of what the light lights, weighted by brightness, as shares of the picture. */
function glow(viewer: Viewer): Promise<{ x: number; y: number }> {
  return viewer.page.evaluate(() => {
    const canvas = document.querySelector('canvas');
    const pixels = canvas?.getContext('2d')?.getImageData(0, 0, canvas.width, canvas.height);
    let [sum, x, y] = [1e-9, 0, 0];
    const { data = [], width = 1, height = 1 } = pixels ?? {};
    for (let i = 0; i < width * height; i += 1) {
      const value = (data[4 * i] ?? 0) ** 2;
      sum += value;
      x += value * ((i % width) / width);
      y += value * (Math.floor(i / width) / height);
    }
    return { x: x / sum, y: y / sum };
  });
}

const isChosen = (handle: Locator): Promise<true> =>
  until('a chosen handle', async () =>
    ((await handle.getAttribute('class')) ?? '').includes('chosen') ? true : null,
  );

async function open(at: string): Promise<Viewer> {
  const viewer = await pages.open(at);
  await viewer.openPanel();
  return viewer;
}

const press = (viewer: Viewer, name: string): Promise<void> =>
  viewer.control(`placed_light.${name}`).locator('button').click();

it('PlacedLight_AddedDraggedAndDeleted_ShinesWhereItsHandleIs', async () => {
  const viewer = await open(kStill);
  await viewer.type('ambient', 0);
  await press(viewer, 'add');
  await count(viewer, 1);
  await viewer.type('placed_light.intensity', 20);
  await viewer.type('placed_light.radius', 8);
  await until('its radius', () => told(viewer)[0]?.radius === 8);
  const handle = viewer.page.locator('#handles .handle');
  await isChosen(handle);
  await viewer.settled();
  await viewer.screenshot('placed-light');

  const box = await handle.boundingBox();
  if (!box) throw new Error('the handle is not visible');
  const before = told(viewer)[0]?.position;
  const lit = await glow(viewer);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await viewer.page.mouse.move(x, y);
  await viewer.page.mouse.down();
  await viewer.page.mouse.move(x - 200, y, { steps: 4 });
  await viewer.page.mouse.up();
  await until('another place', () => {
    const now = told(viewer)[0]?.position;
    return now && before && (now.x !== before.x || now.z !== before.z);
  });
  await until('the handle there', async () => {
    const moved = await handle.boundingBox();
    return Math.abs((moved?.x ?? 0) + 200 - box.x) < 2;
  });
  await viewer.settled();
  expect((await glow(viewer)).x).toBeLessThan(lit.x - 0.02);

  await handle.press('ArrowUp');
  await until('a place above', () => (told(viewer)[0]?.position.y ?? 0) > (before?.y ?? 0));
  await handle.press('Delete');
  await count(viewer, 0);
  await until('no handle', async () => (await handle.count()) === 0);
});

it('PlacedLight_ColourAndKind_AreTheServers', async () => {
  const viewer = await open(kStill);
  await press(viewer, 'add');
  await count(viewer, 1);
  const color = viewer.control('placed_light.color').locator('input[type=text]');
  await color.fill('#ff0000');
  await color.press('Enter');
  await until('red', () => told(viewer)[0]?.color.y === 0 && told(viewer)[0]?.color.x === 1);
  await viewer.choose('placed_light.kind', 'spot');
  await viewer.type('placed_light.outerConeDeg', 60);
  await until('a wider cone', () => Math.abs((told(viewer)[0]?.outerConeDeg ?? 0) - 60) < 1e-6);
  // Refused as a whole: the last good values stay.
  await viewer.type('placed_light.innerConeDeg', 80);
  await until('a refusal', async () =>
    ((await viewer.page.locator('#banner-text').textContent()) ?? '').includes('inner_cone_deg is 80'),
  );
  expect(told(viewer)[0]?.innerConeDeg).toBeCloseTo(30);
  await viewer.type('placed_light.radius', 4);
  await viewer.choose('placed_light.kind', 'area');
  await viewer.type('placed_light.widthM', 2.5);
  await until('a wider rectangle', () => told(viewer)[0]?.widthM === 2.5);
  expect(await viewer.control('placed_light.outerConeDeg').isVisible()).toBe(false);
});

it('SeededLight_DoubleClicked_IsPlaced_Changed_AndGivenBack', async () => {
  const viewer = await open('#size=640x360&lights=1000&animate=0&scene_lights=0&refine=lossless');
  const before = await viewer.settled();
  const canvas = await viewer.page.locator('canvas#view').boundingBox();
  if (!canvas) throw new Error('no canvas');
  const [x, y] = [canvas.x + canvas.width / 2, canvas.y + canvas.height / 2];
  await viewer.page.mouse.dblclick(x, y);
  await count(viewer, 1);
  const [light] = told(viewer);
  expect(light?.replacesSeeded).toBeGreaterThanOrEqual(0);
  expect(difference(await viewer.settled(), before)).toBe(0);
  const handle = viewer.page.locator('#handles .handle');
  await isChosen(handle);
  const box = await handle.boundingBox();
  const reach = 0.06 * (canvas.height / 2);
  expect(Math.abs((box?.x ?? 0) + (box?.width ?? 0) / 2 - x)).toBeLessThan(reach);
  expect(Math.abs((box?.y ?? 0) + (box?.height ?? 0) / 2 - y)).toBeLessThan(reach);

  await viewer.type('placed_light.intensity', 500);
  await viewer.changed('its intensity', before);
  await viewer.choose('placed_light.kind', 'area');
  await until('a rectangle', () => told(viewer)[0]?.kind === LightKind.AREA);
  await press(viewer, 'remove');
  await count(viewer, 0);
  expect(difference(await viewer.settled(), before)).toBe(0);

  // Where nothing is: nothing is placed, and the view goes to where it began.
  const first = viewer.state?.target;
  await viewer.page.locator('#view').press('ArrowLeft');
  await viewer.stateWith('another target', ({ target }) => target?.x !== first?.x || target?.z !== first?.z);
  await viewer.type('lights', 0);
  await viewer.stateWith('no lights', ({ lightCount }) => lightCount === 0);
  await viewer.page.mouse.dblclick(x, y);
  await viewer.stateWith('the first target', ({ target }) => target?.x === first?.x && target?.z === first?.z);
  expect(told(viewer)).toEqual([]);
});

it('LightSet_SavedAndLoaded_IsTheSame_AndNoSetIsRefusedByName', async () => {
  const viewer = await open(kStill);
  await press(viewer, 'add');
  await press(viewer, 'add');
  await count(viewer, 2);
  const before = told(viewer);
  const downloading = viewer.page.waitForEvent('download');
  await press(viewer, 'save');
  const path = await (await downloading).path();
  expect(JSON.parse(readFileSync(path, 'utf8'))).toHaveProperty('lights');
  await press(viewer, 'remove');
  await count(viewer, 1);

  const load = async (name: string, text: string): Promise<void> => {
    const choosing = viewer.page.waitForEvent('filechooser');
    await press(viewer, 'load');
    const file = { name, mimeType: 'application/json', buffer: Buffer.from(text) };
    await (await choosing).setFiles(file);
  };
  await load('set.json', readFileSync(path, 'utf8'));
  await count(viewer, 2);
  expect(told(viewer)).toEqual(before);
  await load('other.json', '{"lights": 3}');
  await until('a refusal', async () =>
    ((await viewer.page.locator('#banner-text').textContent()) ?? '').startsWith("other.json is not a light set",
    ),
  );
  expect(told(viewer)).toEqual(before);
});
