import { create } from '@bufbuild/protobuf';
import { beforeEach, describe, expect, it, vi } from 'vitest';

import { Store } from '../../src/state/store';
import { WindowSize } from '../../src/state/window_size';
import { serverMessage } from '../fakes';
import { FieldRangeSchema } from '../../src/gen/froxel/v1/server_pb';
import { viewState, welcome } from '../sample';

let canvas: { clientWidth: number; clientHeight: number };
let store: Store;
let resized: () => void;
let asked: { query: string; changed: () => void }[];
const screen = { devicePixelRatio: 1 };

beforeEach(() => {
  vi.useFakeTimers();
  canvas = { clientWidth: 640, clientHeight: 360 };
  screen.devicePixelRatio = 1;
  asked = [];
  vi.stubGlobal(
    'ResizeObserver',
    class {
      constructor(action: () => void) {
        resized = action;
      }
      observe(): void {
        // `resized` is called by the tests
      }
    },
  );
  vi.stubGlobal('window', {
    get devicePixelRatio() {
      return screen.devicePixelRatio;
    },
    matchMedia: (query: string) => ({
      addEventListener: (_: string, changed: () => void) => void asked.push({ query, changed }),
    }),
  });
  store = new Store();
  new WindowSize(store, canvas as unknown as HTMLElement);
});

/** A server whose own size is 640×360, and which takes up to 4096 on a side. */
function greet(): void {
  const range = { min: 16, max: 4096 };
  const ranges = ['width', 'height'].map((field) => create(FieldRangeSchema, { field, ...range }));
  const state = viewState({ width: 640, height: 360 });
  store.dispatch({
    type: 'received',
    message: serverMessage({ case: 'welcome', value: { ...welcome(), state, ranges } }),
  });
}
const size = (): unknown => {
  const { width, height } = store.state.settings ?? {};
  return [width, height];
};

describe('WindowSize', () => {
  it('AnotherPixelRatio_IsFollowed_EachTime', () => {
    greet();
    store.dispatch({ type: 'size_mode', mode: { kind: 'auto', scale: 1 } });
    for (const ratio of [2, 1.5]) {
      screen.devicePixelRatio = ratio;
      asked.at(-1)?.changed();
      vi.advanceTimersByTime(500);
      expect(size()).toEqual([640 * ratio, 360 * ratio]);
    }
    expect(asked.map(({ query }) => query)).toEqual(
      [1, 2, 1.5].map((ratio) => `(resolution: ${ratio}dppx)`),
    );
  });

  it.each([0, 2])('PageOf%iPixels_AsksForNothing_AndThenForWhatTheServerProposes', (side) => {
    canvas.clientWidth = canvas.clientHeight = side;
    greet();
    expect(store.state.sizeMode).toBeNull();
    expect(size()).toEqual([640, 360]);
    canvas.clientWidth = 1600;
    canvas.clientHeight = 900;
    resized();
    vi.advanceTimersByTime(500);
    expect(store.state.sizeMode).toEqual({ kind: 'auto', scale: 0.4 });
    expect(size()).toEqual([640, 360]);
  });

  it('WindowThatIsMinimized_KeepsItsSize', () => {
    greet();
    canvas.clientWidth = canvas.clientHeight = 1;
    resized();
    vi.advanceTimersByTime(500);
    expect(size()).toEqual([640, 360]);
  });
});
