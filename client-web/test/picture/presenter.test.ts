import { beforeEach, describe, expect, it } from 'vitest';

import { Codec } from '../../src/gen/froxel/v1/common_pb';
import { Presenter, type FrameTimes } from '../../src/picture/presenter';
import { LostSync } from '../../src/picture/video_track';
import type { Frame } from '../../src/protocol/framing';
import { FakeFrames, frameHeader, settle } from '../fakes';

interface Decode {
  readonly id: bigint;
  readonly finish: () => Promise<void>;
  readonly fail: (error?: Error) => Promise<void>;
}

let frames: FakeFrames;
let decodes: Decode[];
let painted: bigint[];
let acks: bigint[];
let times: FrameTimes[];
let clockMs: number;
let problems: string[];
let losses: boolean[];
let openBitmaps: number;
let presenter: Presenter;

const frame = (id: number): Frame => ({
  header: frameHeader({ frameId: BigInt(id) }),
  payload: new Uint8Array(),
});

const video = (id: number, keyFrame = false): Frame => ({
  header: frameHeader({ frameId: BigInt(id), parts: [{ codec: Codec.VP9, keyFrame }] }),
  payload: new Uint8Array(),
});

function bitmap(id: bigint): ImageBitmap & { id: bigint } {
  openBitmaps += 1;
  return { id, width: 1, height: 1, close: () => void (openBitmaps -= 1) };
}

beforeEach(() => {
  frames = new FakeFrames();
  decodes = [];
  painted = [];
  acks = [];
  times = [];
  clockMs = 0;
  problems = [];
  losses = [];
  openBitmaps = 0;
  presenter = new Presenter({
    decode: ({ header }) =>
      new Promise((resolve, reject) => {
        decodes.push({
          id: header.frameId,
          finish: () => (resolve(bitmap(header.frameId)), settle()),
          fail: (error = new Error('bad JPEG')) => (reject(error), settle()),
        });
      }),
    nextFrame: frames.next,
    nowMs: () => clockMs,
    paint: (image) => {
      painted.push((image as ReturnType<typeof bitmap>).id);
      image.close();
    },
    acknowledge: (ack) => {
      acks.push(ack.frameId);
      times.push(ack);
    },
    painted: () => undefined,
    problem: (text) => void problems.push(text),
    lostSync: ({ broken }) => void losses.push(broken),
  });
});

describe('Presenter', () => {
  it('Frame_IsPaintedAtTheNextAnimationFrameAndAcknowledgedThen', async () => {
    presenter.offer(frame(1));
    await decodes[0]?.finish();
    expect(acks).toEqual([]);
    frames.run();
    expect(painted).toEqual([1n]);
    expect(acks).toEqual([1n]);
    expect(openBitmaps).toBe(0);
  });

  it('Acknowledgement_TellsWhatThePageTook', async () => {
    clockMs = 100;
    presenter.offer(frame(1));
    clockMs = 104.5;
    await decodes[0]?.finish();
    clockMs = 116;
    frames.run();
    expect(times).toEqual([{ frameId: 1n, receiveToPaintUs: 16_000, decodeUs: 4_500 }]);
  });

  it('Acknowledgement_AfterAComputerSlept_SaysAnHourAtMost', async () => {
    presenter.offer(frame(1));
    clockMs += 2 * 3_600_000; // more microseconds than a uint32 holds
    await decodes[0]?.finish();
    clockMs -= 3 * 3_600_000; // a clock that was set back
    frames.run();
    expect(times).toEqual([{ frameId: 1n, receiveToPaintUs: 0, decodeUs: 3_600_000_000 }]);
  });

  it('Decodes_AreTwoAtMostAndTheNewestWaits', async () => {
    for (const id of [1, 2, 3, 4, 5]) presenter.offer(frame(id));
    expect(decodes.map(({ id }) => id)).toEqual([1n, 2n]);
    expect(acks).toEqual([3n, 4n]); // given up for 5
    await decodes[0]?.finish();
    expect(decodes.map(({ id }) => id)).toEqual([1n, 2n, 5n]);
    expect(presenter.droppedCount).toBe(2);
  });

  it('DecodedTwiceBeforeAPaint_TheNewerIsShown', async () => {
    presenter.offer(frame(1));
    presenter.offer(frame(2));
    await decodes[0]?.finish();
    await decodes[1]?.finish();
    frames.run();
    expect(painted).toEqual([2n]);
    expect(acks).toEqual([1n, 2n]);
    expect(openBitmaps).toBe(0);
  });

  it('DecodedOutOfOrder_TheOlderIsDropped', async () => {
    presenter.offer(frame(1));
    presenter.offer(frame(2));
    await decodes[1]?.finish();
    await decodes[0]?.finish();
    frames.run();
    expect(painted).toEqual([2n]);
    expect(acks).toEqual([1n, 2n]);
    expect(openBitmaps).toBe(0);
  });

  it('DecodedAfterANewerOneWasPainted_IsNotAcknowledgedAgain', async () => {
    presenter.offer(frame(1));
    presenter.offer(frame(2));
    await decodes[1]?.finish();
    frames.run();
    await decodes[0]?.finish();
    expect(acks).toEqual([2n]);
    expect(presenter.droppedCount).toBe(1);
    expect(openBitmaps).toBe(0);
  });

  it('BadPicture_IsReportedAndAcknowledgedAndTheNextOneShown', async () => {
    presenter.offer(frame(1));
    await decodes[0]?.fail();
    expect(problems).toEqual(['bad JPEG']);
    expect(acks).toEqual([1n]);
    presenter.offer(frame(2));
    await decodes[1]?.finish();
    frames.run();
    expect(painted).toEqual([2n]);
  });

  it('Video_EveryFrameIsDecodedInOrderAndTheNewestPainted', async () => {
    presenter.offer(video(1, true));
    for (const id of [2, 3, 4]) presenter.offer(video(id));
    expect(decodes.map(({ id }) => id)).toEqual([1n, 2n]);
    expect(presenter.droppedCount).toBe(0);
    for (const index of [0, 1, 2, 3]) await decodes[index]?.finish();
    expect(decodes.map(({ id }) => id)).toEqual([1n, 2n, 3n, 4n]);
    frames.run();
    expect(painted).toEqual([4n]);
    expect(acks).toEqual([1n, 2n, 3n, 4n]);
    expect(openBitmaps).toBe(0);
  });

  it('Video_KeyFrame_ReplacesWhatWaits', () => {
    presenter.offer(video(1, true));
    for (const id of [2, 3, 4]) presenter.offer(video(id));
    presenter.offer(video(5, true));
    expect(acks).toEqual([3n, 4n]);
  });

  it('Video_LostSync_IsToldApartFromABadPicture', async () => {
    presenter.offer(video(1));
    await decodes[0]?.fail(new LostSync('video: gone', true));
    expect(losses).toEqual([true]);
    expect(problems).toEqual([]);
    expect(acks).toEqual([1n]);
  });

  it('HiddenPage_AcknowledgesNothingUntilItIsSeenAgain', async () => {
    presenter.setVisible(false);
    presenter.offer(frame(1));
    presenter.offer(frame(2));
    expect(decodes.length).toBe(0);
    expect(acks).toEqual([]);
    presenter.setVisible(true);
    await decodes[0]?.finish();
    frames.run();
    expect(painted).toEqual([2n]);
    expect(acks).toEqual([2n]); // an acknowledgement covers all frames before it
  });

  it('HiddenWhileAPictureWaits_PaintsItAfterwards', async () => {
    presenter.offer(frame(1));
    await decodes[0]?.finish();
    presenter.setVisible(false);
    frames.run();
    expect(acks).toEqual([]);
    presenter.setVisible(true);
    frames.run();
    expect(painted).toEqual([1n]);
  });

  it('HiddenWhileDecoding_ABadPictureIsAcknowledged', async () => {
    presenter.offer(frame(1));
    presenter.setVisible(false);
    await decodes[0]?.fail();
    expect(acks).toEqual([1n]); // nothing else would open the window again
  });

  it('Restart_IgnoresWhatTheOldConnectionLeft', async () => {
    presenter.offer(frame(8));
    presenter.offer(frame(9));
    await decodes[0]?.finish();
    presenter.restart();
    await decodes[1]?.finish();
    expect(openBitmaps).toBe(0);
    presenter.offer(frame(1));
    await decodes[2]?.finish();
    frames.run();
    expect(painted).toEqual([1n]);
    expect(acks).toEqual([1n]);
  });

  it('Restart_AfterLaterFramesWereAcknowledged_AcknowledgesFromOneAgain', async () => {
    presenter.offer(frame(9));
    await decodes[0]?.finish();
    frames.run();
    presenter.restart();
    presenter.offer(frame(1));
    await decodes[1]?.finish();
    frames.run();
    expect(painted).toEqual([9n, 1n]);
    expect(acks).toEqual([9n, 1n]);
  });
});
