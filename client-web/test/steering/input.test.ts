import { beforeEach, describe, expect, it, vi } from 'vitest';

import type { Pose } from '../../src/steering/camera_controller';
import { CanvasInput, type View, wheelFactor } from '../../src/steering/input';

class FakeCanvas extends EventTarget {
  clientHeight = 100;
  setPointerCapture(): void {
    // nothing to capture without a screen
  }
  focus(): void {
    // nor to focus
  }
}

let canvas: FakeCanvas;
let input: CanvasInput;
let view: View | null;
let halfHeight: number | null;
let inRoom: boolean;
let refusals: number;
let frames: ((nowMs: number) => void)[];

function send(type: string, fields: object): Event {
  const event = Object.assign(new Event(type, { cancelable: true }), fields);
  canvas.dispatchEvent(event);
  return event;
}

const pointer = (type: string, pointerId: number, x: number, y: number, more: object = {}): void =>
  void send(type, { pointerId, clientX: x, clientY: y, buttons: 1, shiftKey: false, altKey: false, ...more });

const key = (code: string, shiftKey = false, ctrlKey = false, more: object = {}): KeyboardEvent =>
  ({ code, shiftKey, ctrlKey, metaKey: false, altKey: false, ...more }) as KeyboardEvent;

function current(): View {
  if (!view) throw new Error('no view');
  return view;
}

beforeEach(() => {
  vi.stubGlobal('WheelEvent', { DOM_DELTA_LINE: 1 });
  canvas = new FakeCanvas();
  frames = [];
  halfHeight = null;
  inRoom = false;
  refusals = 0;
  view = {
    eye: { x: 0, y: 0, z: 10 },
    target: { x: 0, y: 0, z: 0 },
    up: { x: 0, y: 1, z: 0 },
    fovDeg: 90,
    orthographic: false,
    halfHeight: 2,
  };
  const target = {
    view: () => view,
    setPose: (pose: Pose) => (view = view && { ...view, ...pose }),
    setHalfHeight: (value: number) => (halfHeight = value),
    refused: () => (refusals += 1),
    flySpeed: () => 2,
    closestM: () => 0.05,
    isInRoom: () => inRoom,
  };
  input = new CanvasInput(canvas as unknown as HTMLElement, target, (action) => frames.push(action));
});

describe('pointers', () => {
  it('Drag_Orbits', () => {
    pointer('pointerdown', 1, 0, 0);
    pointer('pointermove', 1, 50, 0);
    expect(current().eye.x).toBeCloseTo(-10, 9);
    expect(current().target).toEqual({ x: 0, y: 0, z: 0 });
  });

  it.each([
    ['Room_Drag', true, false],
    ['Outside_AltDrag', false, true],
  ])('%s_LooksAround_WhatIsSeenFollowsThePointer', (_, room, altKey) => {
    inRoom = room;
    pointer('pointerdown', 1, 0, 0);
    pointer('pointermove', 1, 50, 0, { altKey });
    // Half of a picture of 90 degrees to the right: the view turns 45 degrees to the left.
    expect(current().eye).toEqual({ x: 0, y: 0, z: 10 });
    expect(current().target.x).toBeCloseTo(-10 * Math.SQRT1_2, 9);
    expect(current().target.z).toBeCloseTo(10 - 10 * Math.SQRT1_2, 9);
  });

  it.each([
    ['AltDrag', false, true],
    ['OrthographicDrag', true, false],
  ])('Room_%s_Orbits', (_, orthographic, altKey) => {
    inRoom = true;
    view = { ...current(), orthographic };
    pointer('pointerdown', 1, 0, 0);
    pointer('pointermove', 1, 50, 0, { altKey });
    expect(current().eye.x).toBeCloseTo(-10, 9);
    expect(current().target).toEqual({ x: 0, y: 0, z: 0 });
  });

  it('Room_RightArrow_TurnsRight', () => {
    inRoom = true;
    expect(input.keyDown(key('ArrowRight', false, false, { key: 'ArrowRight' }))).toBe(true);
    expect(current().eye).toEqual({ x: 0, y: 0, z: 10 });
    expect(current().target.x).toBeGreaterThan(0);
  });

  it('NothingToSteer_ADragIsRefusedOnce_AndSoAreWheelAndKeys', () => {
    view = null;
    pointer('pointerdown', 1, 0, 0);
    for (const x of [10, 20, 30]) pointer('pointermove', 1, x, 0);
    expect(refusals).toBe(1);
    send('wheel', { deltaY: 100, deltaMode: 0 });
    expect(refusals).toBe(2);
    input.keyDown(key('ArrowLeft', false, false, { key: 'ArrowLeft' }));
    expect(refusals).toBe(3);
    pointer('pointerup', 1, 0, 0);
    pointer('pointermove', 1, 50, 0, { buttons: 0 });
    expect(refusals).toBe(3);
  });

  it('MoveWithoutAButton_DoesNothing', () => {
    pointer('pointermove', 1, 50, 0);
    expect(current().eye.z).toBe(10);
  });

  it.each([
    ['pointerup', {}],
    ['pointercancel', {}],
    ['lostpointercapture', {}],
    ['pointermove', { buttons: 0 }], // it went up over a menu of the browser's
  ])('DragAfter_%s_DoesNothing', (type, how) => {
    pointer('pointerdown', 1, 0, 0);
    pointer(type, 1, 0, 0, how);
    pointer('pointermove', 1, 50, 0);
    expect(current().eye.z).toBe(10);
  });

  it('OneOfTwoFingersLifts_TheOtherGoesOnFromWhereItIs', () => {
    pointer('pointerdown', 1, 0, 0);
    pointer('pointerdown', 2, 50, 0);
    pointer('pointerup', 2, 50, 0);
    pointer('pointermove', 1, 0, 0);
    expect(current().eye).toEqual({ x: 0, y: 0, z: 10 });
    pointer('pointermove', 1, 50, 0);
    expect(current().eye.x).toBeCloseTo(-10, 9);
  });

  it.each([
    ['right button', { buttons: 2 }],
    ['shift', { shiftKey: true }],
  ])('DragWith_%s_Pans', (_, how) => {
    pointer('pointerdown', 1, 0, 0);
    pointer('pointermove', 1, 10, 0, how);
    // The picture spans 20 m at the target; a tenth of it follows the pointer.
    expect(current().target.x).toBeCloseTo(-2, 9);
    expect(current().eye.x).toBeCloseTo(-2, 9);
  });

  it('PinchApart_ComesCloser', () => {
    pointer('pointerdown', 1, 40, 50);
    pointer('pointerdown', 2, 60, 50);
    pointer('pointermove', 2, 80, 50);
    const { eye, target } = current();
    expect(Math.hypot(eye.x - target.x, eye.z - target.z)).toBeCloseTo(5, 9);
  });
});

describe('wheel', () => {
  it('Perspective_ZoomsAndKeepsThePageStill', () => {
    const event = send('wheel', { deltaY: -100, deltaMode: 0 });
    expect(event.defaultPrevented).toBe(true);
    expect(current().eye.z).toBeLessThan(10);
  });

  const turn = { deltaX: 0, deltaY: 0, deltaMode: 0, ctrlKey: false, shiftKey: false };

  it('Pinch_ZoomsAsMuchAsTheFingers_AndAWheelWithControlAsWithout', () => {
    expect(wheelFactor({ ...turn, deltaY: -2, ctrlKey: true }, 500)).toBeCloseTo(Math.exp(-0.02), 12);
    expect(wheelFactor({ ...turn, deltaY: 7, ctrlKey: true }, 500)).toBeCloseTo(Math.exp(0.07), 12);
    const notch = { ...turn, deltaY: 120 };
    expect(wheelFactor({ ...notch, ctrlKey: true }, 500)).toBe(wheelFactor(notch, 500));
  });

  it('LinesAndPages_AreAsManyPixels', () => {
    expect(wheelFactor({ ...turn, deltaY: 3, deltaMode: 1 }, 500)).toBe(wheelFactor({ ...turn, deltaY: 48 }, 500));
    expect(wheelFactor({ ...turn, deltaY: 1, deltaMode: 2 }, 500)).toBe(wheelFactor({ ...turn, deltaY: 500 }, 500));
  });

  it('WithShift_BrowsersTurnItSideways_AndItZoomsAllTheSame', () => {
    expect(wheelFactor({ ...turn, deltaX: 100, shiftKey: true }, 500)).toBe(wheelFactor({ ...turn, deltaY: 100 }, 500));
    expect(wheelFactor({ ...turn, deltaX: 100 }, 500)).toBe(1);
  });

  it('Orthographic_ChangesItsHeight', () => {
    view = { ...current(), orthographic: true };
    send('wheel', { deltaY: 100, deltaMode: 0 });
    expect(halfHeight).toBeGreaterThan(2);
  });
});

describe('flight', () => {
  /** Runs one animation frame `seconds` after the last. */
  const frame = (nowMs: number): void => frames.shift()?.(nowMs);

  it('HeldKeys_MoveWithTimeUntilReleased', () => {
    vi.spyOn(performance, 'now').mockReturnValue(0);
    input.keyDown(key('KeyW'));
    frame(50);
    expect(current().eye.z).toBeCloseTo(10 - 2 * 0.05, 9);
    input.keyUp(key('KeyW'));
    frame(100);
    expect(current().eye.z).toBeCloseTo(9.9, 9);
    expect(frames.length).toBe(0);
  });

  it('Shift_IsFaster', () => {
    vi.spyOn(performance, 'now').mockReturnValue(0);
    input.keyDown(key('KeyD', true));
    frame(50);
    expect(current().eye.x).toBeCloseTo(4 * 2 * 0.05, 9);
  });

  it('AStall_IsNoLeap', () => {
    vi.spyOn(performance, 'now').mockReturnValue(0);
    input.keyDown(key('KeyE'));
    frame(60_000);
    expect(current().eye.y).toBeCloseTo(2 * 0.1, 9);
  });

  it('LostFocus_ReleasesTheKeys', () => {
    input.keyDown(key('KeyW'));
    input.releaseAll();
    frame(1e9);
    expect(current().eye.z).toBe(10);
  });

  it('ShiftThatComesLater_IsFaster_AndThenNot', () => {
    vi.spyOn(performance, 'now').mockReturnValue(0);
    input.keyDown(key('KeyD'));
    input.keyDown(key('ShiftLeft', true));
    frame(50);
    expect(current().eye.x).toBeCloseTo(4 * 2 * 0.05, 9);
    input.keyUp(key('ShiftLeft'));
    frame(100);
    expect(current().eye.x).toBeCloseTo(5 * 2 * 0.05, 9);
  });

  it('CommandDownWhileFlying_EndsTheFlight', () => {
    input.keyDown(key('KeyW'));
    input.keyDown(key('MetaLeft', false, false, { metaKey: true }));
    frame(1e9); // macOS never tells that the fly key went up
    expect(current().eye.z).toBe(10);
  });

  it('PlacesOfFlyKeys_SteerWhateverTheirLetters', () => {
    expect(input.keyDown(key('KeyS', false, false, { key: 'r' }))).toBe(true);
    expect(input.keyDown(key('KeyR', false, false, { key: 'p' }))).toBe(false);
  });

  it('OtherKeys_AreNotOurs', () => {
    input.keyDown(key('KeyX'));
    input.keyDown(key('KeyS', false, true));
    expect(frames.length).toBe(0);
  });
});

describe('keys', () => {
  const press = (name: string, shiftKey = false): boolean => input.keyDown(key('', shiftKey, false, { key: name }));

  it('Arrows_Turn_WithShiftPan', () => {
    expect(press('ArrowRight')).toBe(true);
    expect(current().eye.x).toBeGreaterThan(0);
    expect(current().target).toEqual({ x: 0, y: 0, z: 0 });
    press('ArrowLeft');
    expect(current().eye.x).toBeCloseTo(0, 9);
    press('ArrowRight', true);
    expect(current().target.x).toBeGreaterThan(0);
  });

  it('PlusAndMinus_Zoom', () => {
    press('+');
    expect(current().eye.z).toBeCloseTo(10 / 1.1, 9);
    press('-');
    expect(current().eye.z).toBeCloseTo(10, 9);
  });

  it('NothingToSteer_TakesNoKey', () => {
    view = null;
    expect(press('ArrowRight')).toBe(false);
  });
});
