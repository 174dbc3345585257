// The video codec in a real browser: WebCodecs shows what JPEG shows, and is left where it fails.

import { expect, it } from 'vitest';

import { Codec } from '../src/gen/froxel/v1/common_pb';
import { usePages } from './pages';
import { until, type Viewer } from './viewer';

const kStill = '#size=321x181&animate=0&lights=200&quality=100&chroma=444&codec=jpeg&refine=none';
const kMoving = '#size=320x180&animate=1&lights=50&codec=vp9';

const pages = usePages();

async function open(hash: string): Promise<Viewer> {
  const viewer = await pages.open(hash);
  await viewer.openPanel();
  return viewer;
}

/** The whole picture as bytes of R, G and B. */
function pixels(viewer: Viewer): Promise<number[]> {
  return viewer.page.evaluate(() => {
    const source = document.querySelector('canvas');
    const context = source?.getContext('2d');
    if (!source || !context) return [];
    const { data } = context.getImageData(0, 0, source.width, source.height);
    return [...data].filter((_, index) => index % 4 !== 3);
  });
}

/** In decibels. */
function psnr(a: readonly number[], b: readonly number[]): number {
  const squares = a.reduce((sum, value, index) => sum + (value - (b[index] ?? 0)) ** 2, 0);
  return 10 * Math.log10((255 ** 2 * a.length) / squares);
}

function mean(values: readonly number[], channel: number): number {
  const own = values.filter((_, index) => index % 3 === channel);
  return own.reduce((sum, value) => sum + value, 0) / own.length;
}

/** Breaks the bytes of the next `count` frames of video before the decoder gets them. */
function corrupt(viewer: Viewer, count: number): Promise<void> {
  return viewer.page.evaluate((left) => {
    interface Request {
      parts?: { codec: number }[];
      bytes: Uint8Array;
    }
    type Post = (this: Worker, ...rest: unknown[]) => void;
    const post = Reflect.get(Worker.prototype, 'postMessage') as Post;
    Worker.prototype.postMessage = function (this: Worker, ...rest: unknown[]): void {
      const { parts, bytes } = rest[0] as Request;
      if (left > 0 && parts?.[0]?.codec === 10) {
        left -= 1;
        bytes.fill(0);
      }
      post.apply(this, rest);
    };
  }, count);
}

const isVideo = ({ lastFrame }: Viewer): boolean => lastFrame?.parts[0]?.codec === Codec.VP9;
const requests = ({ sent }: Viewer): number =>
  sent.filter(({ body }) => body.case === 'requestKeyFrame').length;
const paints = (viewer: Viewer, count: number): Promise<unknown> => {
  const from = viewer.frameCount;
  return until(`${count} more frames`, () => viewer.frameCount >= from + count);
};

it('Video_OfAnOddSize_ShowsWhatJpegShows', async () => {
  const viewer = await open(kStill);
  await viewer.settled();
  const jpeg = await pixels(viewer);
  for (const [chroma, least] of [
    ['444', 36],
    ['420', 30],
  ] as const) {
    await viewer.choose('chroma', chroma);
    await viewer.choose('codec', 'vp9');
    await viewer.stateWith('vp9', (state) => state.codec === Codec.VP9);
    await until('a picture by video', () => isVideo(viewer));
    await viewer.settled();
    const video = await pixels(viewer);
    expect(video.length).toBe(321 * 181 * 3);
    expect(psnr(video, jpeg)).toBeGreaterThan(least);
    for (const channel of [0, 1, 2]) {
      expect(Math.abs(mean(video, channel) - mean(jpeg, channel))).toBeLessThan(1);
    }
  }
});

it('Video_Moving_GoesOnOverSizesAndBackToJpeg', async () => {
  const viewer = await open(kMoving);
  await until('a frame that is no key frame', () => {
    const part = viewer.lastFrame?.parts[0];
    return part?.codec === Codec.VP9 && !part.keyFrame;
  });
  await viewer.openFigures();
  await until('the codec among the figures', async () => {
    const figures = await viewer.page.locator('#stats-list').textContent();
    return /Codec.*vp9 · .*bit\/s/.test(figures ?? '');
  });
  await viewer.page.evaluate(() => (location.hash = '#size=200x120'));
  await until('the other size', () => viewer.lastFrame?.width === 200);
  await paints(viewer, 5);
  expect(isVideo(viewer)).toBe(true);
  await viewer.choose('codec', 'jpeg');
  await until('JPEG', () => viewer.lastFrame?.parts[0]?.codec === Codec.JPEG);
  await paints(viewer, 3);
  expect(requests(viewer)).toBe(0);
});

it('Video_FrameThatBreaksTheDecoder_IsFollowedByAKeyFrame', async () => {
  const viewer = await open(kMoving);
  await until('video', () => isVideo(viewer));
  await corrupt(viewer, 1);
  await until('a request', () => requests(viewer) > 0);
  await paints(viewer, 10);
  await viewer.settled();
  expect(isVideo(viewer)).toBe(true);
  expect(requests(viewer)).toBeLessThan(3);
});

it('Video_DecoderFailsAgainAndAgain_FallsBackToJpegAndStaysThere', async () => {
  const viewer = await open(kMoving);
  await until('video', () => isVideo(viewer));
  await corrupt(viewer, 1_000);
  await viewer.stateWith('JPEG', (state) => state.codec === Codec.JPEG);
  await until('the reason', async () =>
    (await viewer.page.locator('#banner').textContent())?.includes('back to JPEG'),
  );
  await until('JPEG', () => viewer.lastFrame?.parts[0]?.codec === Codec.JPEG);
  await paints(viewer, 10);
  expect(isVideo(viewer)).toBe(false);
});
