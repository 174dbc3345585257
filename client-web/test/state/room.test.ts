import { create } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { ErrorCode, RoomStateSchema, type RoomState } from '../../src/gen/froxel/v1/server_pb';
import { kInitialState, reduce, type Action, type AppState } from '../../src/state/app_state';
import { isAsking, mayControl, roomFromAddress, roomOf, roomText, type Room } from '../../src/state/room';
import { SettingsSync } from '../../src/state/settings_sync';
import { Store } from '../../src/state/store';
import { serverMessage } from '../fakes';
import { viewState, welcome } from '../sample';

const run = (state: AppState, ...actions: Action[]): AppState => actions.reduce(reduce, state);
const received = (body: Parameters<typeof serverMessage>[0]): Action => ({
  type: 'received',
  message: serverMessage(body),
});
const roomOfTwo = (you: bigint, controller: bigint): RoomState =>
  create(RoomStateSchema, { room: 'hall', you, controller, memberCount: 2 });
const enter = (you: bigint, controller: bigint, lightCount = 1000): Action =>
  received({
    case: 'welcome',
    value: {
      ...welcome(),
      state: viewState({ lightCount }),
      defaults: viewState(),
      room: roomOfTwo(you, controller),
    },
  });
const told = (you: bigint, controller: bigint): Action =>
  received({ case: 'roomState', value: roomOfTwo(you, controller) });
const edit = (lights: number): Action => ({ type: 'edit', patch: { lights } });

describe('watching', () => {
  const watching = run(kInitialState, enter(9n, 7n, 50));

  it('ShowsTheRoomsState_NotTheLinks', () => {
    const wanted: Action = { type: 'restored', wanted: { lights: 5 }, size: null };
    const state = run(kInitialState, wanted, enter(9n, 7n, 50));
    expect(state.settings?.lights).toBe(50);
    expect(state.server?.initial.lights).toBe(1000);
    expect(mayControl(state.room)).toBe(false);
  });

  it('Edits_HaveNoEffect', () => {
    expect(run(watching, edit(3)).settings?.lights).toBe(50);
  });

  it('States_AreFollowed', () => {
    const state = run(
      watching,
      received({ case: 'state', value: { refSeq: 0n, state: viewState({ lightCount: 60 }) } }),
    );
    expect(state.settings?.lights).toBe(60);
    expect(state.sent).toBe(state.settings);
  });

  it('ControlGained_EditsCount_Lost_TheyAreForgotten', () => {
    const mine = run(watching, told(9n, 9n), edit(3));
    expect(mine.settings?.lights).toBe(3);
    const lost = run(mine, told(9n, 7n));
    expect(lost.settings?.lights).toBe(50);
    expect(lost.sent).toBe(lost.settings);
  });

  it('Refusal_SaysWhoControls', () => {
    const state = run(
      watching,
      received({
        case: 'error',
        value: { code: ErrorCode.CONTROL, refSeq: 4n, message: 'viewer 7 controls room hall' },
      }),
    );
    expect(state.notice?.text).toContain('viewer 7');
    expect(state.settings?.lights).toBe(50);
  });

  it('SendsNothing_UntilControlComes', () => {
    const sent: (string | undefined)[] = [];
    const store = new Store();
    new SettingsSync(
      store,
      { send: (body) => BigInt(sent.push(body.case)), backlogBytes: 0 },
      (action) => action(0),
    );
    store.dispatch({ type: 'restored', wanted: { lights: 5, exposure: 2 }, size: null });
    store.dispatch(enter(9n, 7n, 50));
    store.dispatch(edit(3));
    expect(sent).toEqual([]);
    store.dispatch(told(9n, 9n));
    expect(sent).toEqual([]);
    store.dispatch(edit(3));
    expect(sent).toEqual(['setLights']);
  });
});

describe('resumed', () => {
  it('AfterAReload_TheServersStateGoesOn_AndItsDefaultsStayKnown', () => {
    const state = run(
      kInitialState,
      received({
        case: 'welcome',
        value: {
          ...welcome(),
          state: viewState({ lightCount: 50 }),
          defaults: viewState(),
          resumed: true,
        },
      }),
    );
    expect(state.settings?.lights).toBe(50);
    expect(state.server?.initial.lights).toBe(1000);
    expect(state.room).toBeNull();
  });

  it('AnOldServer_KnowsNeitherRoomsNorTokens', () => {
    const state = run(kInitialState, received({ case: 'welcome', value: welcome() }));
    expect(state.room).toBeNull();
    expect(mayControl(state.room)).toBe(true);
    expect(state.server?.protocolMinor).toBe(0);
  });
});

describe('room', () => {
  const room = (controller: bigint, memberCount: number): Room => {
    const members = [{ id: 9n, asking: true }];
    const told = { room: 'hall', you: 9n, controller, memberCount, members };
    return roomOf(create(RoomStateSchema, told));
  };

  it('Text_SaysWhoControlsAndHowManyWatch', () => {
    expect(roomText(room(9n, 3))).toBe('You control room hall; 2 watch.');
    expect(roomText(room(7n, 2))).toBe('Viewer 7 controls room hall; 1 watches.');
    expect(roomText(room(0n, 2))).toBe('Nobody controls room hall; 2 watch.');
    expect(isAsking(room(7n, 2))).toBe(true);
  });

  it.each(['', '?x=1', '?room=hall-2', '?room=a.b_c&x'])('Address %s is understood', (search) => {
    expect('name' in roomFromAddress(search)).toBe(true);
  });

  it.each(['?room=two%20words', '?room=%3Cb%3E', `?room=${'r'.repeat(65)}`])(
    'Address %s is refused with the rule',
    (search) => {
      const wanted = roomFromAddress(search);
      expect('problem' in wanted && wanted.problem).toContain('1 to 64');
    },
  );
});
