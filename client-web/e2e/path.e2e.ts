// Camera paths: keys added, moved, removed, played and scrubbed by mouse, keys and touch; link, file and built-in paths.

import { readFile } from 'node:fs/promises';

import { BufferSource, Input, WEBM } from 'mediabunny';
import { expect, it } from 'vitest';

import { usePages } from './pages';
import { until, type Viewer } from './viewer';

const kStill = '#size=320x180&animate=0&light_time=3&lights=20';
const kEnds = [
  { at_s: 0, eye: [-7, 2, 0], target: [0, 2, 0], fov_deg: 45 },
  { at_s: 2, eye: [5, 3, 1], target: [0, 2, 0], fov_deg: 60 },
];
const kTwo = `${kStill}&path=${encodeURIComponent(JSON.stringify({ seconds: 2, keys: kEnds }))}`;

const pages = usePages();

const eyeZ = ({ state }: Viewer): number => state?.eye?.z ?? NaN;
const near = (viewer: Viewer, x: number): Promise<unknown> =>
  viewer.stateWith(`an eye at ${x}`, ({ eye }) => Math.abs((eye?.x ?? NaN) - x) < 0.05);
const keyCount = ({ page }: Viewer): Promise<number> => page.locator('.path-key').count();
const clock = ({ page }: Viewer): Promise<string | null> => page.locator('#path-clock').textContent();

interface PathJson {
  readonly seconds: number;
  readonly keys: readonly { readonly at_s: number; readonly eye: readonly number[] }[];
}
const linked = (viewer: Viewer): PathJson | null => {
  const text = new URLSearchParams(new URL(viewer.page.url()).hash.slice(1)).get('path');
  return text === null ? null : (JSON.parse(text) as PathJson);
};
const linkedTimes = (viewer: Viewer, times: readonly number[]): Promise<unknown> =>
  until(`keys at ${times.join(', ')} in the link`, () => {
    const keys = linked(viewer)?.keys ?? [];
    return keys.length === times.length && keys.every(({ at_s: atS }, i) => Math.abs(atS - (times[i] ?? NaN)) < 0.06);
  });

it('Keys_AreAddedMovedAndRemoved_ByKeyboard', async () => {
  const viewer = await pages.open(kStill);
  const { page } = viewer;
  await page.locator('#view').press('y');
  await page.locator('#path-add:focus').waitFor();
  await page.keyboard.press('Enter');
  await until('a key', async () => (await keyCount(viewer)) === 1);
  const first = eyeZ(viewer);
  await page.locator('#view').press('Shift+ArrowLeft');
  await viewer.stateWith('another eye', ({ eye }) => eye?.z !== first);
  await page.locator('#path-add').press('Enter');
  await linkedTimes(viewer, [0, 2]);
  const second = page.locator('.path-key').nth(1);
  await second.focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight'); // the key has kept the focus
  await linkedTimes(viewer, [0, 2.2]);
  await page.locator('.path-key').first().press('Enter');
  await viewer.stateWith('the first eye', ({ eye }) => eye?.z === first);
  await page.locator('#path-replace').press('Enter');
  await page.locator('#path-remove').press('Enter');
  await linkedTimes(viewer, [2.2]);
  await page.locator('#path-clear').press('Enter');
  await until('no path in the link', () => linked(viewer) === null);
  expect(await page.locator('#path-play').isDisabled()).toBe(true);
});

it('Path_OfALink_IsPlayedToItsEnd_AndStopsWhereSomebodySteers', async () => {
  const viewer = await pages.open(kTwo);
  const { page } = viewer;
  await page.locator('#path').waitFor();
  expect(await keyCount(viewer)).toBe(2);
  await page.locator('#path-play').click();
  await near(viewer, 5);
  await until('the end', async () => (await clock(viewer)) === '2.0 / 2.0 s');
  expect(await page.locator('#path-play').getAttribute('aria-pressed')).toBe('false');
  // While the view moves, the page asks for a wider picture.
  await viewer.stateWith('the last field of view', ({ fovDeg }) => Math.abs(fovDeg - 60) < 5e-4);
  const sent = viewer.sent.filter(({ body }) => body.case === 'setCamera').length;
  expect(sent).toBeGreaterThan(3);
  await page.locator('#path-loop').check();
  await page.locator('#path-play').click();
  await page.locator('#view').press('Shift+ArrowLeft');
  await until('it stops', async () => (await page.locator('#path-play').getAttribute('aria-pressed')) === 'false');
});

it('Time_IsScrubbed_ByMouse', async () => {
  const viewer = await pages.open(kTwo);
  const box = await viewer.page.locator('#path-time').boundingBox();
  if (!box) throw new Error('no time line');
  const y = box.y + box.height / 2;
  await viewer.page.mouse.move(box.x + 8, y);
  await viewer.page.mouse.down();
  await viewer.page.mouse.move(box.x + box.width / 2, y, { steps: 5 });
  await viewer.page.mouse.up();
  await viewer.stateWith('an eye in the middle', ({ eye }) => Math.abs((eye?.x ?? NaN) + 1) < 1.5);
  await viewer.screenshot('path');
});

it('Key_IsDraggedAlongTheTimeLine_ByMouseAndTouch', async () => {
  const third = { at_s: 1, eye: [0, 4, 2], target: [0, 2, 0] };
  const [a, b] = kEnds;
  const path = encodeURIComponent(JSON.stringify({ seconds: 2, keys: [a, third, b] }));
  const viewer = await pages.open(`${kStill}&path=${path}`, { hasTouch: true });
  const { page } = viewer;
  const track = await page.locator('#path-keys').boundingBox();
  const mark = await page.locator('.path-key').nth(1).boundingBox();
  if (!track || !mark) throw new Error('no keys');
  const [x, y] = [mark.x + mark.width / 2, mark.y + mark.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + track.width / 4, y, { steps: 4 });
  await page.mouse.up();
  await linkedTimes(viewer, [0, 1.5, 2]);
  const session = await page.context().newCDPSession(page);
  const touch = (type: string, at: number): Promise<unknown> =>
    session.send('Input.dispatchTouchEvent', {
      type: type as 'touchStart',
      touchPoints: type === 'touchEnd' ? [] : [{ x: at, y }],
    });
  await touch('touchStart', x + track.width / 4);
  await touch('touchMove', x);
  await touch('touchMove', x - track.width / 4);
  await touch('touchEnd', x - track.width / 4);
  await linkedTimes(viewer, [0, 0.5, 2]);
  await page.locator('.path-key').nth(2).tap();
  await near(viewer, 5);
});

it('BuiltInPaths_AreSavedAndOpenedAsFiles', async () => {
  const viewer = await pages.open(kStill);
  const { page } = viewer;
  await page.locator('#view').press('y');
  await page.locator('#path-turntable').click();
  await until('keys all round', async () => (await keyCount(viewer)) === 24);
  const coming = page.waitForEvent('download');
  await page.locator('#path-save').click();
  const saved = await coming;
  expect(saved.suggestedFilename()).toMatch(/^froxel-.*\.path\.json$/);
  const text = await readFile(await saved.path(), 'utf8');
  expect(JSON.parse(text)).toMatchObject({ seconds: 12, constant_speed: true, loop: true });
  await page.locator('#path-flythrough').click();
  await until('the scene’s cameras', async () => (await keyCount(viewer)) === 6);
  await page.locator('#path-file').setInputFiles({ name: 'round.json', mimeType: 'application/json', buffer: Buffer.from(text) });
  await until('the file', async () => (await keyCount(viewer)) === 24);
  const bad = Buffer.from('{"keys": [{"eye": [0, 0, 1]}]}');
  await page.locator('#path-file').setInputFiles({ name: 'bad.json', mimeType: 'application/json', buffer: bad });
  await until('what is wrong', async () => {
    const said = await page.locator('#path-said').textContent();
    return said === 'bad.json is not a camera path: keys[0].target is missing';
  });
  expect(await keyCount(viewer)).toBe(24);
});

it('LinkWithAPathThatIsNone_SaysWhatIsWrong', async () => {
  const viewer = await pages.open(`${kStill}&path=${encodeURIComponent('{"keys": []}')}`);
  await until('what is wrong', async () => {
    const said = await viewer.page.locator('#path-said').textContent();
    return said === 'link: path: keys has 0; it must have 1 to 1000';
  });
});

it('OrthographicView_HasNoPath_AndSaysSo', async () => {
  const viewer = await pages.open(`${kStill}&half_height=4`);
  await viewer.page.locator('#view').press('y');
  await viewer.page.locator('#path-add').click();
  await until('the reason', async () =>
    (await viewer.page.locator('#path-said').textContent())?.includes('needs a perspective camera'),
  );
});

it('Path_IsRecordedAsAVideo_OfEveryFrame', async () => {
  const viewer = await pages.open(kTwo);
  const { page } = viewer;
  await page.locator('#path-record').click();
  await page.locator('#recording-size').selectOption({ index: 0 });
  await page.locator('#recording-rate').selectOption('15');
  const coming = page.waitForEvent('download', { timeout: 600_000 });
  await page.locator('#recording-start').click();
  const saved = await coming;
  expect(saved.suggestedFilename()).toMatch(/^froxel-.*\.webm$/);
  const input = new Input({ source: new BufferSource(await readFile(await saved.path())), formats: [WEBM] });
  const track = await input.getPrimaryVideoTrack();
  expect(await track?.getCodec()).toBe('vp9');
  expect([await track?.getDisplayWidth(), await track?.getDisplayHeight()]).toEqual([320, 180]);
  expect(await track?.computeDuration()).toBeCloseTo(2, 2);
  const stats = await track?.computePacketStats();
  expect(stats?.packetCount).toBe(30);
  await until('the size', async () => (await page.locator('#recording-said').textContent())?.startsWith('The video has'));
});

it('Recording_IsCancelled_AndTooManyFramesAreRefused', async () => {
  const viewer = await pages.open(kStill);
  const { page } = viewer;
  await page.keyboard.press('Control+k');
  await page.locator('#search-text').fill('record a video');
  await page.locator('#search-list [aria-selected=true]').waitFor();
  await page.keyboard.press('Enter');
  await page.locator('#recording-size').selectOption({ index: 0 });
  await page.locator('#recording-seconds').fill('1000');
  await page.locator('#recording-start').click();
  const said = page.locator('#recording-said');
  await until('the limit', async () => (await said.textContent())?.startsWith('30000 frames are too many'));
  await page.locator('#recording-seconds').fill('100');
  await page.locator('#recording-start').click();
  await until('some frames', async () => /^Frame \d+ of 3000/.test((await said.textContent()) ?? ''));
  await page.locator('#recording-cancel').click();
  await until('its end', async () => (await said.textContent()) === 'The video was not recorded: cancelled');
  expect(await page.locator('#recording-start').isEnabled()).toBe(true);
});
