// The gallery: a scene is chosen, carried by a link, called off, refused, and named by any bytes.

import { copyFileSync, mkdtempSync, rmSync, utimesSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { afterAll, expect, it } from 'vitest';

import { usePages } from './pages';
import { until, type Viewer } from './viewer';

const kStill = '#size=320x180&animate=0&lights=50';
const kHostile = '<img src=x onerror=alert(1)>';
const kTriangle = new URL('../../tests/deploy/triangle.gltf', import.meta.url);

const folder = mkdtempSync(join(tmpdir(), 'froxel_scenes_'));
copyFileSync(kTriangle, join(folder, 'triangle.gltf'));
copyFileSync(kTriangle, join(folder, `${kHostile}.gltf`));
writeFileSync(join(folder, 'broken.glb'), 'this is no GLB');
const kMany = ['a', 'b', 'c', 'd', 'e', 'f', 'g', 'h', 'i', 'j'];
kMany.forEach((letter, day) => {
  copyFileSync(kTriangle, join(folder, `many-${letter}.gltf`));
  const written = Date.UTC(2030, 0, 1 + day) / 1000;
  utimesSync(join(folder, `many-${letter}.gltf`), written, written);
});
afterAll(() => rmSync(folder, { recursive: true }));

const pages = usePages(['--scenes', folder]);

const sceneName = (viewer: Viewer, name: string): Promise<true> =>
  until(`the scene ${name}`, async () =>
    (await viewer.page.locator('#scene-name').textContent()) === name ? true : null,
  );

async function choose(viewer: Viewer, name: string): Promise<void> {
  await viewer.page.locator('#tool-scenes').click();
  const named = viewer.page.locator('span').getByText(name, { exact: true });
  await viewer.page.locator('#scenes-list button').filter({ has: named }).click();
}

it('Gallery_ChosenSceneIsShown_AndALinkCarriesIt', async () => {
  const viewer = await pages.open(kStill);
  const hall = await viewer.picture();
  const fragment = (): string => new URL(viewer.page.url()).hash;
  await choose(viewer, 'triangle');
  await sceneName(viewer, 'triangle');
  await viewer.changed('the triangle', hall);
  await until('the link', () => /scene=[0-9a-f]{16}/.test(fragment()) || null);
  await viewer.page.locator('#tool-scenes').click();
  expect(await viewer.page.locator('#scenes-list [aria-current]').textContent()).toContain('triangle');

  const other = await pages.open(fragment());
  await sceneName(other, 'triangle');
  await viewer.page.keyboard.press('Escape');
  await choose(viewer, 'hall');
  await sceneName(viewer, 'Hall');
});

it('CameraPath_IsOfItsScene_AndComesWithItsLink', async () => {
  const viewer = await pages.open(kStill);
  await choose(viewer, 'triangle');
  await sceneName(viewer, 'triangle');
  await viewer.page.locator('#view').press('y');
  await viewer.page.locator('#path-turntable').click();
  const fragment = (): string => new URL(viewer.page.url()).hash;
  await until('the link', () => fragment().includes('path=') || null);

  const other = await pages.open(fragment());
  await sceneName(other, 'triangle');
  await until('its keys', async () => (await other.page.locator('.path-key').count()) === 24);
  await choose(other, 'hall');
  await sceneName(other, 'Hall');
  await until('no path', async () => (await other.page.locator('.path-key').count()) === 0);
  await until('a link without it', () => !new URL(other.page.url()).hash.includes('path='));
});

it('Gallery_BrokenFile_IsOneLineAndChangesNothing', async () => {
  const viewer = await pages.open(kStill);
  await choose(viewer, 'broken');
  await viewer.told(/broken\.glb/);
  expect(await viewer.page.locator('#scene-name').textContent()).toBe('Hall');
  await choose(viewer, 'triangle');
  await sceneName(viewer, 'triangle');
});

it('Gallery_OrdersByNameOrTime_AndHasSizesWithSideFiles', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.locator('#tool-scenes').click();
  const names = viewer.page.locator('#scenes-list span');
  await until('the scenes', async () => (await names.count()) > kMany.length);
  const byName = await names.allTextContents();
  expect(byName).toEqual([...byName].sort((a, b) => a.localeCompare(b)));
  await viewer.page.locator('#scenes-order').selectOption('newest');
  expect((await names.allTextContents()).slice(0, kMany.length)).toEqual(kMany.map((letter) => `many-${letter}`).reverse());
  // The file's own buffer is in it, so it is as large as it is.
  await until('a size', async () => /GLTF, \d/.test((await viewer.page.locator('#scenes-list small').first().textContent()) ?? ''));
});

it('Gallery_NamesAreText', async () => {
  const viewer = await pages.open(kStill);
  await viewer.page.locator('#tool-scenes').click();
  const item = viewer.page.locator('#scenes-list button').filter({ hasText: 'onerror' });
  await item.waitFor();
  expect(await item.locator('span').textContent()).toBe(kHostile);
  expect(await viewer.page.locator('#scenes img[onerror]').count()).toBe(0);
  await item.click();
  await sceneName(viewer, kHostile);
});

it('Link_ToASceneThatIsGone_SaysSoAndShowsTheFirst', async () => {
  const viewer = await pages.open(`${kStill}&scene=0123456789abcdef`);
  await viewer.told('not a scene of this server');
  expect(await viewer.page.locator('#scene-name').textContent()).toBe('Hall');
});

it('Room_IsChangedForBoth', async () => {
  const first = await pages.open(`?room=salon${kStill}`);
  const second = await pages.open('?room=salon');
  await choose(first, 'triangle');
  await sceneName(first, 'triangle');
  await sceneName(second, 'triangle');
});
