import { describe, expect, it } from 'vitest';

import { Refine } from '../../src/gen/froxel/v1/common_pb';
import { ErrorCode } from '../../src/gen/froxel/v1/server_pb';
import { kInitialState, reduce, type Action, type AppState } from '../../src/state/app_state';
import { serverMessage } from '../fakes';
import { viewState, welcome } from '../sample';

const run = (state: AppState, ...actions: Action[]): AppState => actions.reduce(reduce, state);
const received = (body: Parameters<typeof serverMessage>[0]): Action => ({
  type: 'received',
  message: serverMessage(body),
});
const welcomed = (scene?: string): Action => received({ case: 'welcome', value: welcome(scene) });
const answer = (refSeq: bigint, lightCount: number): Action =>
  received({ case: 'state', value: { refSeq, state: viewState({ lightCount }) } });
const edit = (lights: number): Action => ({ type: 'edit', patch: { lights } });

/** As SettingsSync does after it has told the server. */
function sent(state: AppState, seq: bigint): AppState {
  if (!state.settings) throw new Error('nothing to send');
  return reduce(state, { type: 'sent', seq, settings: state.settings });
}

const live = run(kInitialState, welcomed());

describe('a pick', () => {
  const asked = run(sent(live, 3n), { type: 'picking', pick: { seq: 4n, id: 2 } });
  const placed = (refSeq: bigint): Action =>
    received({
      case: 'state',
      value: { refSeq, state: viewState(), placedLights: { lights: [{ id: 2, position: {} }] } },
    });

  it('Answered_IsTheChosenLight', () => {
    const state = run(asked, placed(4n));
    expect(state.chosenLight).toBe(2);
    expect(state.pick).toBeNull();
    expect(state.settings?.placedLights.map(({ id }) => id)).toContain(2);
  });

  it('AnsweredBeforeItWasHeard_IsWaitedFor', () => {
    const state = run(asked, answer(3n, 5));
    expect(state.pick?.id).toBe(2);
    expect(state.settings?.lights).toBe(1000); // a newer answer is to come
  });

  it('Missed_GoesHome_WithoutAWord', () => {
    const aside = run(asked, { type: 'edit', patch: { eye: { x: 9, y: 9, z: 9 } } });
    const value = { code: ErrorCode.OUT_OF_RANGE, refSeq: 4n, field: 'x', message: 'x hits no light' };
    const state = run(aside, received({ case: 'error', value }));
    expect(state.settings?.eye).toEqual(live.server?.initial.eye);
    expect(state.pick).toBeNull();
    expect(state.notice).toBeNull();
  });

  it('Refused_TakesNoEditBack', () => {
    const value = { code: ErrorCode.OUT_OF_RANGE, refSeq: 4n, field: 'id', message: 'x hits no light' };
    const state = run(asked, edit(7), received({ case: 'error', value }));
    expect(state.settings?.lights).toBe(7);
    expect(state.pick).toBeNull();
    expect(state.chosenLight).toBe(live.chosenLight);
    expect(state.notice?.text).toBe('x hits no light');
  });
});

describe('a camera that is followed', () => {
  const moved = (appliedSeq: bigint, x: number): Action => ({
    type: 'camera_moved',
    appliedSeq,
    pose: { eye: { x, y: 2, z: 0 }, target: { x: 0, y: 2, z: 0 }, up: { x: 0, y: 1, z: 0 } },
  });

  it('Moves_WithoutAWord', () => {
    const state = run(sent(live, 1n), moved(1n, -6));
    expect(state.settings?.eye.x).toBe(-6);
    expect(state.settings).toBe(state.sent);
    expect(state.confirmed?.eye.x).toBe(-6);
  });

  it('FrameFromBeforeACommand_ChangesNothing', () => {
    const steered = sent(run(live, edit(7)), 3n);
    expect(run(steered, moved(2n, -6))).toBe(steered);
    expect(run(live, edit(7), moved(9n, -6)).settings?.eye.x).toBe(-7);
  });

  it('AfterAReconnect_GoesOn', () => {
    const state = viewState({ followedCamera: 'nave' });
    const greeted = received({ case: 'welcome', value: { ...welcome(), state } });
    const before = run(kInitialState, greeted, moved(0n, -6));
    const again = run(before, { type: 'link', link: { phase: 'connecting' } }, greeted);
    expect(again.settings?.eye).toEqual(again.sent?.eye);
  });
});

describe('details', () => {
  it('HoldUntilTheNextOnes', () => {
    expect(live.details).toBeNull();
    const plan = (line: string): Action => received({ case: 'details', value: { plan: [line] } });
    const state = run(live, plan('old'), plan('new'), answer(1n, 5));
    expect(state.details?.plan).toEqual(['new']);
  });
});

describe('welcome', () => {
  it('BringsTheServersStateRangesAndScene', () => {
    expect(live.link.phase).toBe('live');
    expect(live.settings?.lights).toBe(1000);
    expect(live.server?.ranges.get('lights')?.max).toBe(1_000_000);
    expect(live.server?.scene?.cameras).toEqual(['nave', 'gallery']);
    expect(live.sent).toBe(live.confirmed);
  });

  it('WhatTheLinkAskedFor_IsWantedOverTheServersState', () => {
    const wanted: Action = { type: 'restored', wanted: { lights: 5 }, size: null };
    const state = run(kInitialState, wanted, welcomed());
    expect(state.settings?.lights).toBe(5);
    expect(state.sent?.lights).toBe(1000);
  });

  it.each([
    ['restored before Welcome', (wanted: Action) => run(kInitialState, wanted, welcomed())],
    ['restored later', (wanted: Action) => run(live, wanted)],
  ])('ViewWithNothingOfTheSceneInIt_IsTheFirstView_AndSaysSo: %s', (_, open) => {
    const away = { eye: { x: 0, y: 2, z: 1e6 }, target: { x: 0, y: 2, z: 2e6 }, lights: 5 };
    const state = open({ type: 'restored', wanted: away, size: null });
    expect(state.settings?.eye).toEqual(live.settings?.eye);
    expect(state.settings?.lights).toBe(5);
    expect(state.notice?.text).toMatch(/shows nothing of the scene/);
    const seen = open({ type: 'restored', wanted: { ...away, target: { x: 0, y: 2, z: 0 } }, size: null });
    expect(seen.settings?.eye.z).toBe(1e6);
    expect(seen.notice).toBeNull();
  });

  it('AfterAReconnect_TheViewGoesOn', () => {
    const before = sent(run(live, edit(7)), 1n);
    const lost: Action = { type: 'link', link: { phase: 'connecting' } };
    const state = run(before, lost, welcomed());
    expect(state.settings?.lights).toBe(7);
    expect(state.sent?.lights).toBe(1000);
  });

  it('AfterAReconnectToAnotherScene_OnlyPlacesAreForgotten', () => {
    const moved: Action = {
      type: 'edit',
      patch: { lights: 7, eye: { x: 99, y: 99, z: 99 } },
    };
    const state = run(live, moved, welcomed('sponza'));
    expect(state.settings?.lights).toBe(7);
    expect(state.settings?.eye).toEqual({ x: -7, y: 2, z: 0 });
  });

  it('AfterAReconnect_TheWarningOfItIsGoneAndErrorsStay', () => {
    const draining = received({ case: 'draining', value: { deadlineMs: 1 } });
    expect(run(live, draining).notice?.tone).toBe('info');
    expect(run(live, draining, welcomed()).notice).toBeNull();
    const error: Action = { type: 'notice', tone: 'error', text: 'bad link' };
    expect(run(kInitialState, error, welcomed()).notice?.text).toBe('bad link');
  });

  it('SessionThatWasGivenAway_IsSaidInOneLine_AndOneThatGoesOnIsNot', () => {
    const greeted = (resumeToken: string, resumed: boolean): Action =>
      received({ case: 'welcome', value: { ...welcome(), resumeToken, resumed } });
    const kept = run(kInitialState, greeted('secret', false));
    expect(kept.notice).toBeNull();
    expect(run(kept, greeted('other', true)).notice).toBeNull();
    expect(run(kept, greeted('other', false)).notice?.text).toContain('got the place of this view');
    const keepsNone = run(kInitialState, greeted('', false));
    expect(run(keepsNone, greeted('', false)).notice).toBeNull();
    const draining = received({ case: 'draining', value: { deadlineMs: 1 } });
    expect(run(kept, draining, greeted('other', false)).notice).toBeNull();
  });

  it('ServerThatRefines_IsAskedForTheLosslessPictureUnlessTheLinkSaysElse', () => {
    const greeted = (refine: Refine): Action =>
      received({ case: 'welcome', value: { ...welcome(), state: viewState({ refine }) } });
    expect(run(kInitialState, greeted(Refine.HIGH)).settings?.refine).toBe(Refine.LOSSLESS);
    expect(run(kInitialState, greeted(Refine.NONE)).settings?.refine).toBe(Refine.NONE);
    const link: Action = { type: 'restored', wanted: { refine: Refine.NONE }, size: null };
    expect(run(kInitialState, link, greeted(Refine.HIGH)).settings?.refine).toBe(Refine.NONE);
  });

  it('WithoutAState_IsRefused', () => {
    const empty = received({ case: 'welcome', value: { protocolMajor: 1 } });
    expect(run(kInitialState, empty).link.phase).toBe('refused');
  });
});

describe('answers', () => {
  it('ToTheNewestCommand_AreAdopted', () => {
    const state = run(sent(run(live, edit(5)), 3n), answer(3n, 6));
    expect(state.settings?.lights).toBe(6);
    expect(state.sent).toBe(state.settings);
  });

  it('ToAnOlderCommand_DoNotMoveTheControlsBack', () => {
    const state = run(sent(run(live, edit(5)), 3n), answer(2n, 4));
    expect(state.settings?.lights).toBe(5);
    expect(state.confirmed?.lights).toBe(4);
  });

  it('WhileAnEditIsUnsent_DoNotUndoIt', () => {
    const state = run(sent(run(live, edit(5)), 3n), edit(9), answer(3n, 5));
    expect(state.settings?.lights).toBe(9);
  });
});

describe('errors', () => {
  const error = (refSeq: bigint): Action =>
    received({
      case: 'error',
      value: { code: ErrorCode.OUT_OF_RANGE, refSeq, message: 'lights = 1e9: 0 to 100000' },
    });

  it('OfACommand_TakeTheSettingsBackToTheLastGoodOnes', () => {
    const state = run(sent(run(live, edit(1e9)), 1n), error(1n));
    expect(state.settings?.lights).toBe(1000);
    expect(state.sent?.lights).toBe(1000);
    expect(state.notice).toMatchObject({ text: 'lights = 1e9: 0 to 100000', tone: 'error' });
  });

  it('OfNoCommand_OnlyShow', () => {
    const before = run(live, edit(5));
    expect(run(before, error(0n)).settings?.lights).toBe(5);
  });

  it('OfTheToken_ChangeNothing', () => {
    const before = run(live, edit(5));
    const value = { code: ErrorCode.TOKEN, refSeq: 1n, message: 'token is unknown' };
    expect(run(before, received({ case: 'error', value }))).toEqual(before);
  });

  it('Dismiss_TakesTheNoticeAway', () => {
    expect(run(live, error(0n), { type: 'dismiss' }).notice).toBeNull();
  });
});

describe('others', () => {
  it('Loading_IsShownUntilWelcome', () => {
    const loading = received({ case: 'loading', value: { stage: 'textures', fraction: 0.5 } });
    const state = run(kInitialState, loading);
    expect(state.loading).toEqual({ stage: 'textures', fraction: 0.5 });
    expect(run(state, welcomed()).loading).toBeNull();
  });

  it('Edit_BeforeWelcome_IsKeptForIt', () => {
    expect(run(kInitialState, edit(3), welcomed()).settings?.lights).toBe(3);
  });

  it('Disconnect_ForgetsWhatTheServerWasTold', () => {
    const state = run(live, { type: 'link', link: { phase: 'connecting' } });
    expect(state.sent).toBeNull();
    expect(state.settings?.lights).toBe(1000);
  });
});

describe('a refusal', () => {
  const value = { code: ErrorCode.CAPACITY, refSeq: 4n, message: 'too large' };
  const refused = run(sent(live, 4n), received({ case: 'error', value }));

  it('IsSaidUntilALaterCommandIsAnswered', () => {
    expect(run(refused, answer(4n, 5)).notice?.text).toBe('too large'); // takes the command back
    expect(run(refused, answer(5n, 5)).notice).toBeNull();
    // Sent together: the answer to what was sent beside it is no reason to forget it.
    const beside = run(sent(live, 6n), received({ case: 'error', value }));
    expect(run(beside, answer(6n, 5)).notice?.text).toBe('too large');
    expect(run(beside, answer(7n, 5)).notice).toBeNull();
  });

  it('IsOverOnAnotherScene', () => {
    const changed = received({
      case: 'sceneChanged',
      value: { scene: { name: 'fox', id: 'fox' }, state: viewState(), defaults: viewState() },
    });
    expect(run(refused, changed).notice).toBeNull();
  });
});
