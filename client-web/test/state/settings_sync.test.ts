import { beforeEach, describe, expect, it } from 'vitest';

import type { ClientBody } from '../../src/protocol/framing';
import type { Settings } from '../../src/settings/settings';
import { SettingsSync } from '../../src/state/settings_sync';
import { Store } from '../../src/state/store';
import { FakeFrames, serverMessage } from '../fakes';
import { viewState, welcome } from '../sample';

let store: Store;
let frames: FakeFrames;
let bodies: ClientBody[];
let open: boolean;
const sender = {
  backlogBytes: 0,
  send(body: ClientBody): bigint | null {
    if (!open) return null;
    bodies.push(body);
    return BigInt(bodies.length);
  },
};
const edit = (patch: Partial<Settings>): void => store.dispatch({ type: 'edit', patch });
const cases = (): string[] => bodies.map((body) => String(body.case));

function receiveWelcome(): void {
  const message = serverMessage({ case: 'welcome', value: welcome() });
  store.dispatch({ type: 'received', message });
}

beforeEach(() => {
  store = new Store();
  frames = new FakeFrames();
  bodies = [];
  open = true;
  sender.backlogBytes = 0;
  new SettingsSync(store, sender, frames.next);
  receiveWelcome();
});

describe('SettingsSync', () => {
  it('Welcome_WithNothingWanted_SendsNothing', () => {
    frames.run();
    expect(bodies).toEqual([]);
  });

  it('Welcome_AnsweredWithAnEditByOthers_SendsEachCommandOnce', () => {
    store = new Store();
    // As the picture's size follows the window.
    store.listen(({ server }, before) => {
      if (server !== before.server) edit({ width: 321 });
    });
    new SettingsSync(store, sender, frames.next);
    edit({ lights: 9 });
    receiveWelcome();
    frames.run();
    expect(bodies).toMatchObject([
      { case: 'setSize', value: { width: 321 } },
      { case: 'setLights', value: { count: 9 } },
    ]);
    expect(store.state.sent).toBe(store.state.settings);
    expect(store.state.sentSeq).toBe(2n);
  });

  it('DiscreteChanges_GoOutAtOnceAndOneByOne', () => {
    edit({ lights: 1 });
    edit({ lights: 2 });
    edit({ lights: 1 });
    expect(bodies.map((body) => body.value)).toEqual([{ count: 1 }, { count: 2 }, { count: 1 }]);
  });

  it('AnotherCamera_IsToldUntilItIsTheViewsOwn', () => {
    store = new Store();
    let lead = 1;
    new SettingsSync(store, sender, frames.next, (settings) =>
      lead === 0 ? settings : { ...settings, eye: { ...settings.eye, x: settings.eye.x + lead } },
    );
    receiveWelcome();
    edit({ eye: { x: 5, y: 0, z: 0 } });
    frames.run();
    expect(bodies.at(-1)?.value).toMatchObject({ eye: { x: 6 } });
    frames.run(); // the same
    expect(bodies.length).toBe(1);
    edit({ lights: 7 });
    lead = 0;
    frames.run();
    expect(cases()).toEqual(['setCamera', 'setLights', 'setCamera']);
    expect(bodies.at(-1)?.value).toMatchObject({ eye: { x: 5 } });
    expect(store.state.sent).toBe(store.state.settings);
    frames.run();
    expect(frames.count).toBe(0);
  });

  it('CameraMoves_GoOutOnceAFrameAndTheLatestWins', () => {
    for (let x = 1; x <= 5; x += 1) edit({ eye: { x, y: 0, z: 0 } });
    expect(bodies).toEqual([]);
    frames.run();
    expect(cases()).toEqual(['setCamera']);
    expect(bodies[0]?.value).toMatchObject({ eye: { x: 5, y: 0, z: 0 } });
    frames.run();
    expect(bodies.length).toBe(1);
  });

  it('SettingWithAMovingCamera_DoesNotWaitForIt', () => {
    edit({ eye: { x: 1, y: 0, z: 0 } });
    edit({ lights: 9 });
    expect(cases()).toEqual(['setLights']);
    frames.run();
    expect(cases()).toEqual(['setLights', 'setCamera']);
    expect(store.state.sent).toBe(store.state.settings);
  });

  it('MoveThereAndBackWithinAFrame_SendsNothing', () => {
    const eye = store.state.settings?.eye ?? { x: 0, y: 0, z: 0 };
    edit({ eye: { x: 1, y: 0, z: 0 } });
    edit({ eye });
    frames.run();
    expect(bodies).toEqual([]);
  });

  it('Backlog_HoldsTheCameraBackButNotSettings', () => {
    sender.backlogBytes = 1e6;
    edit({ eye: { x: 1, y: 0, z: 0 } });
    edit({ quality: 9 });
    frames.run();
    expect(cases()).toEqual(['setEncoding']);
    sender.backlogBytes = 0;
    frames.run();
    expect(cases()).toEqual(['setEncoding', 'setCamera']);
  });

  it('Reconnect_TellsTheServerAgain', () => {
    edit({ lights: 9, eye: { x: 1, y: 0, z: 0 } });
    frames.run();
    bodies.length = 0;
    open = false;
    store.dispatch({ type: 'link', link: { phase: 'connecting' } });
    edit({ quality: 3 });
    expect(bodies).toEqual([]);
    open = true;
    receiveWelcome();
    frames.run();
    expect(bodies).toMatchObject([
      { case: 'setLights', value: { count: 9 } },
      { case: 'setEncoding', value: { quality: 3 } },
      { case: 'setCamera', value: { eye: { x: 1 } } },
    ]);
  });

  it('AdoptedAnswer_IsNotSentBack', () => {
    edit({ lights: 9 });
    store.dispatch({
      type: 'received',
      message: serverMessage({
        case: 'state',
        value: { refSeq: 1n, state: viewState({ lightCount: 9, lightRadiusM: 5 }) },
      }),
    });
    frames.run();
    expect(store.state.settings?.lightRadius).toBe(5);
    expect(bodies.length).toBe(1);
  });
});
