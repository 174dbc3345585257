// A scene of one's own: chosen or dropped, sent, shown, linked, deleted.

import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { zipSync } from 'fflate';
import { afterAll, expect, it } from 'vitest';

import { usePages } from './pages';
import { until, type Viewer } from './viewer';

const kStill = '#size=320x180&animate=0&lights=50';
const folder = mkdtempSync(join(tmpdir(), 'froxel_uploads_'));
afterAll(() => rmSync(folder, { recursive: true }));

const kTriangle = readFileSync(new URL('../../tests/deploy/triangle.gltf', import.meta.url));
const gltf = JSON.parse(kTriangle.toString()) as { buffers: { uri: string }[] };
const kBuffer = Buffer.from(gltf.buffers[0]?.uri.split(',')[1] ?? '', 'base64');
const kApart = Buffer.from(JSON.stringify({ ...gltf, buffers: [{ uri: 'parts/a%20b.bin', byteLength: kBuffer.length }] }));

const put = (name: string, content: Buffer | Uint8Array): string => {
  const path = join(folder, name);
  writeFileSync(path, content);
  return path;
};
const kAlone = put('alone.gltf', kTriangle);
const kWithoutParts = put('apart.gltf', kApart);
const kZip = put('packed.zip', zipSync({ 'top/apart.gltf': kApart, 'top/parts/a b.bin': kBuffer, '__MACOSX/x': kBuffer }));
const kText = put('notes.txt', Buffer.from('no scene'));

const pages = usePages(['--uploads', 'auto', '--upload-folder', join(folder, 'store')]);

const choose = (viewer: Viewer, ...paths: string[]): Promise<void> => viewer.page.locator('#bring-input').setInputFiles(paths);
const text = (viewer: Viewer): Promise<string> => viewer.page.locator('#bring-text').innerText();
const says = (viewer: Viewer, words: string): Promise<true> =>
  until(words, async () => ((await text(viewer)).includes(words) ? true : null));
const press = (viewer: Viewer, button: string): Promise<void> =>
  viewer.page.locator('#bring-buttons button').getByText(button, { exact: true }).click();
const sceneName = (viewer: Viewer, name: string): Promise<true> =>
  until(`the scene ${name}`, async () => ((await viewer.page.locator('#scene-name').textContent()) === name ? true : null));

async function open(): Promise<Viewer> {
  const viewer = await pages.open(kStill);
  await viewer.page.locator('#tool-open').waitFor({ state: 'visible' });
  return viewer;
}

it('ChosenFile_IsSentAndShown_ALinkCarriesIt_AndItsOwnerDeletesIt', async () => {
  const viewer = await open();
  const hall = await viewer.picture();
  await choose(viewer, kAlone);
  await sceneName(viewer, 'alone');
  await viewer.changed('the triangle', hall);
  await says(viewer, 'Everybody who has the link can see alone.gltf.');
  const fragment = await until('the link', () => /#.*scene=[0-9a-f]{32}/.exec(viewer.page.url())?.[0] ?? null);

  const other = await pages.open(fragment);
  await sceneName(other, 'alone');
  expect(await other.page.locator('#bring').isVisible(), 'another browser brought it').toBe(false);

  await viewer.page.reload();
  await viewer.picture();
  await says(viewer, 'can see alone.gltf'); // it knows that it was brought from here
  await press(viewer, 'Delete now');
  await says(viewer, 'alone.gltf is deleted.');
  const third = await pages.open(kStill);
  const answer = await third.page.request.get(new URL(`/render?scene=${fragment.slice(-32)}`, pages.url).href);
  expect(answer.status()).toBe(404);
});

it('Drop_OfAFolderOfFiles_AndOfAZip_AreTheSame', async () => {
  const viewer = await open();
  await viewer.page.evaluate(
    ({ scene, buffer }) => {
      const transfer = new DataTransfer();
      const bytes = (base64: string): Uint8Array<ArrayBuffer> => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      transfer.items.add(new File([bytes(scene)], 'apart.gltf'));
      transfer.items.add(new File([bytes(buffer)], 'other.bin'));
      const event = { dataTransfer: transfer, bubbles: true, cancelable: true };
      document.body.dispatchEvent(new DragEvent('dragover', event));
      document.body.dispatchEvent(new DragEvent('drop', event));
    },
    { scene: kApart.toString('base64'), buffer: kBuffer.toString('base64') },
  );
  await says(viewer, 'apart.gltf needs a file that is not among these.');
  expect(await viewer.page.locator('#bring-list').innerText()).toBe('parts/a b.bin');
  await press(viewer, 'Close');
  await choose(viewer, kZip);
  await sceneName(viewer, 'apart');
  await says(viewer, 'can see apart.gltf');
});

it('WhatIsNoScene_IsSaid', async () => {
  const viewer = await open();
  await choose(viewer, kText);
  await says(viewer, 'There is no scene among these files.');
  await choose(viewer, kWithoutParts);
  await says(viewer, 'needs a file that is not among these');
  await press(viewer, 'Open without');
  await until('the refusal', async () => (await viewer.page.locator('#banner-text').innerText()).includes('a b.bin') || null);
  await choose(viewer, kAlone, kWithoutParts);
  await says(viewer, 'There are 2 scenes.');
  await viewer.page.locator('#bring-list button').getByText('alone.gltf', { exact: true }).click();
  await sceneName(viewer, 'alone');
});

it('ConnectionThatIsLost_IsTakenUpAgain', async () => {
  const viewer = await open();
  let lost = 0;
  await viewer.page.route('**/api/v1/uploads/*', async (route) => {
    if (route.request().method() === 'PATCH' && ++lost <= 2) await route.abort('connectionreset');
    else await route.continue();
  });
  await choose(viewer, kAlone);
  await sceneName(viewer, 'alone');
  expect(lost).toBe(3);
  viewer.complaints.length = 0; // the browser's own, of the lost connections
});
