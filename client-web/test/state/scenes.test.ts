import { beforeEach, describe, expect, it } from 'vitest';

import { ErrorCode } from '../../src/gen/froxel/v1/server_pb';
import type { ClientBody } from '../../src/protocol/framing';
import { keepScene } from '../../src/state/scene_sync';
import { Store } from '../../src/state/store';
import { serverMessage } from '../fakes';
import { kBounds, viewState, welcome } from '../sample';

let store: Store;
let sent: ClientBody[];

const received = (body: Parameters<typeof serverMessage>[0]): void =>
  store.dispatch({ type: 'received', message: serverMessage(body) });
const welcomeTo = (id: string): void =>
  received({ case: 'welcome', value: welcome(id, id) });
const changedTo = (id: string): void =>
  received({
    case: 'sceneChanged',
    value: {
      scene: { name: id, id, cameras: ['top'], bounds: kBounds },
      state: viewState({ lightCount: 3 }),
      defaults: viewState({ lightCount: 3 }),
    },
  });
const asked = (): unknown[] =>
  sent.map((body) => (body.case === 'selectScene' ? body.value.scene : body.case));

beforeEach(() => {
  store = new Store();
  sent = [];
  keepScene(store, {
    backlogBytes: 0,
    send(body) {
      sent.push(body);
      return BigInt(sent.length);
    },
  });
});

describe('a scene', () => {
  it('Chosen_IsAskedForOnce_AndShownWhenItIsThere', () => {
    welcomeTo('hall');
    store.dispatch({ type: 'want_scene', scene: 'fox' });
    received({ case: 'sceneLoading', value: { scene: 'fox', stage: 'reading', fraction: 0.5 } });
    received({ case: 'state', value: { refSeq: 1n, state: viewState() } });
    expect(asked()).toEqual(['fox']);
    expect(store.state.sceneLoading).toEqual({ scene: 'fox', stage: 'reading', fraction: 0.5 });
    expect(store.state.server?.scene?.name).toBe('hall');
    changedTo('fox');
    received({ case: 'sceneLoading', value: {} });
    expect(store.state.sceneLoading).toBeNull();
    expect(store.state.server?.scene?.cameras).toEqual(['top']);
    expect(store.state.settings?.lights).toBe(3);
    expect(store.state.sent?.lights).toBe(3);
    expect(store.state.server?.initial.lights).toBe(3);
    expect(store.state.wantedScene).toBeNull();
  });

  it('TheOneThatIsShown_CallsOffTheOneOnItsWay', () => {
    welcomeTo('hall');
    store.dispatch({ type: 'want_scene', scene: 'fox' });
    received({ case: 'sceneLoading', value: { scene: 'fox', stage: 'reading', fraction: 0 } });
    store.dispatch({ type: 'want_scene', scene: 'hall' });
    expect(asked()).toEqual(['fox', 'hall']);
  });

  it('TheOneThatIsShown_IsNotAskedFor', () => {
    welcomeTo('hall');
    store.dispatch({ type: 'want_scene', scene: 'hall' });
    expect(asked()).toEqual([]);
  });

  it('OfAnAddress_IsShownWithWhatTheAddressSays', () => {
    store.dispatch({ type: 'restored', wanted: { lights: 42 }, size: null, scene: 'fox' });
    welcomeTo('hall');
    expect(asked()).toEqual(['fox']);
    expect(store.state.settings?.lights).toBe(1000); // the hall stays as it is
    changedTo('fox');
    expect(store.state.settings?.lights).toBe(42);
    expect(store.state.confirmed?.lights).toBe(3); // so that the server is told
  });

  it('OfAnAddress_ThatIsShownAlready_NeedsNoAsking', () => {
    store.dispatch({ type: 'restored', wanted: { lights: 42 }, size: null, scene: 'hall' });
    welcomeTo('hall');
    expect(asked()).toEqual([]);
    expect(store.state.settings?.lights).toBe(42);
  });

  it('ThatCannotBeHad_IsSaid_AndChangesNothing', () => {
    store.dispatch({ type: 'restored', wanted: { lights: 42 }, size: null, scene: 'gone' });
    welcomeTo('hall');
    const { settings } = store.state;
    const value = { code: ErrorCode.OUT_OF_RANGE, refSeq: 1n, field: 'scene', message: 'scene is "gone"' };
    received({ case: 'error', value });
    expect(store.state.settings).toBe(settings);
    expect(store.state.notice?.text).toBe('scene is "gone"');
    expect(store.state.wantedScene).toBeNull();
  });

  it('OfALostSession_IsAskedForAgain_AndIsAsItWas', () => {
    welcomeTo('hall');
    store.dispatch({ type: 'want_scene', scene: 'fox' });
    changedTo('fox');
    store.dispatch({ type: 'edit', patch: { lights: 77 } });
    store.dispatch({ type: 'link', link: { phase: 'greeting' } });
    welcomeTo('hall');
    expect(asked()).toEqual(['fox', 'fox']);
    changedTo('fox');
    expect(store.state.settings?.lights).toBe(77);
  });

  it('OfAServerOfOneScene_IsNotAskedFor', () => {
    store.dispatch({ type: 'restored', wanted: { lights: 42 }, size: null, scene: 'fox' });
    welcomeTo('');
    expect(asked()).toEqual([]);
    expect(store.state.settings?.lights).toBe(42);
  });
});
