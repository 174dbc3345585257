// The picture from the camera of now, while the server's own is on its way.

import { expect, it } from 'vitest';

import { usePages } from './pages';
import { difference, until, type Viewer } from './viewer';

const kLit = '#animate=0&scene_lights=1&lights=200&refine=none'; // whatever the link seems to carry
const kStill = `${kLit}&size=640x360`;
const pages = usePages();

const isWarped = (viewer: Viewer): Promise<boolean> => viewer.page.locator('#warp').isVisible();

async function drag(viewer: Viewer, dx: number): Promise<void> {
  const { mouse } = viewer.page;
  await mouse.move(600, 300);
  await mouse.down();
  await mouse.move(600 + dx, 300, { steps: 4 });
}

/** How far the server's picture is from the one before a move, and from what the page shows while the server is held. */
async function movedWhileHeld(viewer: Viewer, move: () => Promise<void>): Promise<{ moved: number; missed: number }> {
  pages.hold(true);
  let [before, warped]: number[][] = [[], []];
  try {
    before = await viewer.pageThumbnail();
    await move();
    await until('the picture from another camera', () => isWarped(viewer));
    warped = await viewer.pageThumbnail();
  } finally {
    pages.hold(false);
  }
  await viewer.page.mouse.up();
  await viewer.settled();
  await until('the picture itself', async () => !(await isWarped(viewer)));
  const after = await viewer.pageThumbnail();
  return { moved: difference(before, after), missed: difference(warped, after) };
}

it.each([
  ['Jpeg', '&size=640x360'],
  ['Video', '&size=640x360&codec=vp9'],
  ['AnOddSize', '&size=517x291'],
  ['AForwardRenderer', '&size=640x360&renderer=forward_plus'],
])('DraggedCamera_Of%s_IsShownBeforeTheServerDrawsIt', async (_, settings) => {
  const viewer = await pages.open(kLit + settings);
  await until('depth', () => viewer.depths.size > 0);
  await viewer.settled();
  expect(await isWarped(viewer)).toBe(false);
  const { moved, missed } = await movedWhileHeld(viewer, () => drag(viewer, 30));
  expect(moved).toBeGreaterThan(3);
  expect(missed).toBeLessThan(0.35 * moved);
});

it('ScaledPicture_IsWarpedToo', async () => {
  const viewer = await pages.open('#animate=0&scene_lights=1&lights=200&size=1280x720&target_fps=120');
  await until('depth', () => viewer.depths.size > 0);
  const { mouse } = viewer.page;
  await mouse.move(600, 300);
  await mouse.down();
  let x = 600;
  await until('a scaled picture', async () => {
    x = x === 600 ? 610 : 600;
    await mouse.move(x, 300);
    return viewer.lastFrame && viewer.lastFrame.scale < 1 && viewer.lastFrame.depthMesh > 0n;
  });
  const { moved, missed } = await movedWhileHeld(viewer, () => mouse.move(660, 300, { steps: 4 }));
  expect(moved).toBeGreaterThan(3);
  expect(missed).toBeLessThan(0.5 * moved);
});

it('Watcher_SeesTheViewMoveFromPictureToPicture', async () => {
  const first = await pages.open(`?room=gallery${kStill}`);
  const second = await pages.open('?room=gallery');
  const asksForDepth = ({ sent }: Viewer): boolean => sent.some(({ body }) => body.case === 'requestDepth');
  await until('both to ask for depth', () => asksForDepth(first) && asksForDepth(second));
  const { mouse } = first.page;
  await mouse.move(600, 300);
  await mouse.down();
  let x = 600;
  await until('a view between two pictures', async () => {
    x = x < 900 ? x + 4 : 600;
    await mouse.move(x, 300);
    return isWarped(second);
  });
  await mouse.up();
  await first.settled();
  await until('the picture itself in both', async () => !(await isWarped(first)) && !(await isWarped(second)));
  const shown = await first.thumbnail();
  await until('the same picture in both', async () => difference(await second.thumbnail(), shown) === 0);
});

it('ManyMoves_EndAtTheServersPicture', async () => {
  const viewer = await pages.open(kStill);
  await until('depth', () => viewer.depths.size > 0);
  for (const dx of [80, -160, 60, -20]) {
    await drag(viewer, dx);
    await viewer.page.mouse.up();
  }
  await viewer.settled();
  await until('the picture itself', async () => !(await isWarped(viewer)));
  expect(viewer.depths.size).toBeGreaterThan(1);
});

it('LostGraphicsDevice_LeavesThePictureAsItComes', async () => {
  const viewer = await pages.open(kStill);
  await until('depth', () => viewer.depths.size > 0);
  await viewer.settled();
  await viewer.page.evaluate(() => {
    const canvas = document.querySelector<HTMLCanvasElement>('#warp');
    canvas?.getContext('webgl2')?.getExtension('WEBGL_lose_context')?.loseContext();
  });
  await until('no depth wanted any more', () =>
    viewer.sent.some(({ body }) => body.case === 'requestDepth' && !body.value.wanted),
  );
  const before = await viewer.thumbnail();
  await drag(viewer, 60);
  expect(await isWarped(viewer)).toBe(false);
  await viewer.page.mouse.up();
  expect(difference(before, await viewer.settled())).toBeGreaterThan(1);
});

it('TurnedOff_AsksForNoDepth', async () => {
  const viewer = await pages.open(`?reprojection=off${kStill}`);
  await viewer.settled();
  await drag(viewer, 60);
  await viewer.page.mouse.up();
  await viewer.settled();
  expect(viewer.depths.size).toBe(0);
  expect(viewer.sent.some(({ body }) => body.case === 'requestDepth')).toBe(false);
});
