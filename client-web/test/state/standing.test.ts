import { create } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { kInitialState, reduce, type AppState } from '../../src/state/app_state';
import { FrameHeaderSchema } from '../../src/gen/froxel/v1/server_pb';
import { serverMessage } from '../fakes';
import { count } from '../../src/core/format';
import { welcome } from '../sample';
import { kSlowMs, pictureLabel, standingOf, type Moment, type Standing } from '../../src/state/standing';

const welcomed = reduce(
  kInitialState,
  { type: 'received', message: serverMessage({ case: 'welcome', value: welcome() }) },
);
const live: AppState = { ...kInitialState, link: { phase: 'live' } };
const standing = (state: AppState, moment: Partial<Moment> = {}): Standing =>
  standingOf(state, { nowMs: 1_000, hasPicture: true, lagMs: 0, shown: null, ...moment });

describe('standingOf', () => {
  it('Live_SaysNothing', () => {
    expect(standing(live)).toMatchObject({ text: '', aside: '', remedy: null, progress: null, dims: false });
  });

  it('BeforeTheFirstPicture_IsProgressAndNoBanner', () => {
    const first = { hasPicture: false };
    expect(standing(kInitialState, first)).toMatchObject({ text: '', progress: { text: 'Connecting…', fraction: null } });
    expect(standing(live, first).progress?.text).toBe('Waiting for the first picture…');
    const loading = { ...kInitialState, loading: { stage: 'reading the scene', fraction: 0.426 } };
    expect(standing(loading, first).progress).toEqual({ text: 'Reading the scene, 43 %', fraction: 0.426 });
  });

  it('ConnectingAgain_DimsTheOldPicture', () => {
    expect(standing(kInitialState)).toMatchObject({ text: 'Connecting…', progress: null, dims: true });
    const loading = { ...kInitialState, loading: { stage: 'reading the scene', fraction: 1 } };
    expect(standing(loading)).toMatchObject({
      text: 'The server restarted.',
      aside: 'Reading the scene, 100 %.',
    });
  });

  it('TooDearForTheMachine_SaysHowLargeItIsShown', () => {
    const shown = create(FrameHeaderSchema, { fullSizeUs: 1_234_000, width: 426, height: 240 });
    const { text, tone, remedy } = standing(welcomed, { shown });
    expect([text, tone, remedy]).toEqual([
      'This machine needs 1.2 s a picture at 960×540; shown at 426×240.', 'info', null,
    ]);
    expect(standing(welcomed, { shown: create(FrameHeaderSchema, { width: 426, height: 240 }) }).text).toBe('');
  });

  it('Notice_LeavesTheProgressInSight', () => {
    const notice = { text: 'too large', tone: 'error' } as const;
    const sceneLoading = { scene: 'fox', stage: 'reading', fraction: 0.5 };
    expect(standing({ ...live, notice })).toMatchObject({ text: 'too large', progress: null });
    const progress = { text: 'Reading, 50 %', fraction: 0.5 };
    expect(standing({ ...live, notice, sceneLoading })).toMatchObject({ text: 'too large', progress });
  });

  it('ShadersAreCompiled_SaysSo_RatherThanThatTheViewIsSlow', () => {
    const loading = { stage: 'compiling shaders', fraction: 0 };
    expect(standing({ ...live, loading }, { lagMs: 9_000 })).toMatchObject({
      text: 'This view is drawn for the first time.',
      aside: 'Compiling shaders.',
    });
  });

  it('Waiting_CountsDownAndMayBeCutShort', () => {
    const waiting: AppState = {
      ...live,
      link: { phase: 'waiting', reason: 'Every place is taken.', retryAtMs: 3_500 },
      notice: { text: 'of before', tone: 'info' },
    };
    expect(standing(waiting, { hasPicture: false })).toEqual({
      text: 'Every place is taken.',
      tone: 'error',
      aside: 'Next try in 3 s.',
      remedy: { label: 'Try now', act: 'connect' },
      progress: null,
      dims: false,
    });
    expect(standing(waiting, { nowMs: 9_000 })).toMatchObject({ aside: 'Next try in 0 s.', dims: true });
  });

  it('Refused_HasTheRemedyOfItsReason', () => {
    const remedy = { label: 'Reload', act: 'reload' } as const;
    const refused: AppState = { ...live, link: { phase: 'refused', reason: 'Another version.', remedy } };
    expect(standing(refused)).toMatchObject({ text: 'Another version.', tone: 'error', remedy, dims: true });
    const final: AppState = { ...live, link: { phase: 'refused', reason: 'No room.', remedy: null } };
    expect(standing(final).remedy).toBeNull();
  });

  it('Notice_MayBeDismissed_AndOfTwoThingsTheConnectionCounts', () => {
    const told: AppState = { ...live, notice: { text: 'exposure = -1', tone: 'error' } };
    expect(standing(told)).toMatchObject({ text: 'exposure = -1', remedy: { act: 'dismiss' }, dims: false });
    expect(standing({ ...told, link: { phase: 'connecting' } }).dims).toBe(true);
  });

  it('AnotherSceneOnItsWay_MayBeCalledOff', () => {
    const sceneLoading = { scene: 'fox', stage: 'reading the scene', fraction: 0.426 };
    expect(standing({ ...live, sceneLoading }, { lagMs: 9_000 })).toMatchObject({
      text: 'Another scene is loading.',
      aside: 'Reading the scene, 43 %.',
      remedy: { label: 'Cancel', act: 'stay' },
      dims: false,
    });
  });

  it('Slow_IsSaidAfterAWhileAndNotWithoutAConnection', () => {
    expect(standing(live, { lagMs: kSlowMs - 1 }).text).toBe('');
    expect(standing(live, { lagMs: 4_200 })).toMatchObject({ tone: 'info', aside: '4 s behind.', dims: false });
    expect(standing(live, { lagMs: 4_200 }).text).toContain('slow');
    expect(standing(live, { lagMs: 4_200, hasPicture: false }).text).toBe('');
    expect(standing(kInitialState, { lagMs: 4_200 }).text).toBe('Connecting…');
  });
});

describe('pictureLabel', () => {
  it('Picture_IsNamedByItsSceneAndHowItIsDrawn', () => {
    expect(pictureLabel(kInitialState)).toBe('The picture, which has not arrived yet');
    const scene = welcomed.server?.scene?.name ?? '';
    expect(pictureLabel(welcomed)).toMatch(`${scene}, drawn by clustered deferred with ${count(1000)} lights.`);
  });
});
