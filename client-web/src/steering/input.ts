// Mouse, wheel, keys and touch on the canvas, as camera moves.
//
//   left drag turns · right, middle or shift drag pans · wheel zooms · WASD and QE fly
//   arrows turn, with shift pan · + and - zoom
//   one finger turns · two fingers pan and pinch
//
// To turn is to orbit about the target, or inside a room to look around, since an orbit would carry
// the eye through the wall behind it. With alt it is the other of the two.

import { fly, look, orbit, pan, zoom, type Pose } from './camera_controller';

export interface View extends Pose {
  readonly fovDeg: number;
  readonly orthographic: boolean;
  readonly halfHeight: number;
}

export interface InputTarget {
  /** Null while there is nothing to steer, or somebody else steers. */
  view(): View | null;
  /** Input came while there is none. */
  refused(): void;
  setPose(pose: Pose): void;
  setHalfHeight(halfHeight: number): void;
  /** Metres a second of flight. */
  flySpeed(): number;
  /** Metres from its target that a zoom ends at. */
  closestM(): number;
  /** Whether the eye is inside a room. */
  isInRoom(): boolean;
}

const kRadPerHeight = Math.PI; // a drag over the whole canvas turns half around
const kZoomPerPixel = 0.0015;
const kPixelsPerUnit: readonly number[] = [1, 16]; // of WheelEvent.deltaMode: pixels, lines; else pages
const kLongestPinch = 0.15; // of one event, as a notch of a wheel
const kFastFactor = 4;
const kLongestStepS = 0.1; // after a stall the camera does not leap

/** Direction of flight of each key: right, up, forward. Codes, not letters: places on any layout. */
const kFlyKeys: ReadonlyMap<string, readonly [number, number, number]> = new Map([
  ['KeyW', [0, 0, 1]],
  ['KeyS', [0, 0, -1]],
  ['KeyA', [-1, 0, 0]],
  ['KeyD', [1, 0, 0]],
  ['KeyE', [0, 1, 0]],
  ['KeyQ', [0, -1, 0]],
]);

/** Shares of the canvas's height that an arrow key drags by. */
const kArrowStep = 0.04;
const kArrows: ReadonlyMap<string, readonly [number, number]> = new Map([
  ['ArrowLeft', [-kArrowStep, 0]],
  ['ArrowRight', [kArrowStep, 0]],
  ['ArrowUp', [0, -kArrowStep]],
  ['ArrowDown', [0, kArrowStep]],
]);
const kZoomKeys: ReadonlyMap<string, number> = new Map([
  ['+', 1 / 1.1],
  ['=', 1 / 1.1],
  ['-', 1.1],
]);

interface Pointer {
  readonly x: number;
  readonly y: number;
}

/** What a turn of the wheel multiplies distances by; `pageHeight` is the canvas's, in pixels. */
export function wheelFactor(
  { deltaX, deltaY, deltaMode, ctrlKey, shiftKey }: Pick<WheelEvent, 'deltaX' | 'deltaY' | 'deltaMode' | 'ctrlKey' | 'shiftKey'>,
  pageHeight: number,
): number {
  // Browsers turn a wheel that is turned with shift sideways.
  const delta = deltaY === 0 && shiftKey ? deltaX : deltaY;
  const pixels = delta * (kPixelsPerUnit[deltaMode] ?? pageHeight);
  const zoom = pixels * kZoomPerPixel;
  if (!ctrlKey) return Math.exp(zoom);
  // A pinch on a trackpad, by as much as browsers zoom pages. Control and a wheel look the same,
  // but for their long steps.
  return Math.exp(Math.sign(zoom) * Math.max(Math.min(Math.abs(pixels) / 100, kLongestPinch), Math.abs(zoom)));
}

export class CanvasInput {
  private readonly pointers = new Map<number, Pointer>();
  private readonly keys = new Set<string>();
  private lastStepMs: number | null = null; // null: not flying
  private fast = false;

  constructor(
    private readonly canvas: HTMLElement,
    private readonly target: InputTarget,
    private readonly nextFrame: (action: (nowMs: number) => void) => void,
  ) {
    canvas.addEventListener('pointerdown', (event) => this.pointerDown(event));
    canvas.addEventListener('pointermove', (event) => this.pointerMove(event));
    for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      canvas.addEventListener(type, (event) => void this.pointers.delete(event.pointerId));
    }
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  /** Whether it steered. */
  keyDown(event: KeyboardEvent): boolean {
    this.noteModifiers(event);
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    if (kFlyKeys.has(event.code)) {
      this.keys.add(event.code);
      this.scheduleStep();
      return true;
    }
    return this.turnOrZoom(event);
  }

  keyUp(event: KeyboardEvent): void {
    this.noteModifiers(event);
    this.keys.delete(event.code);
  }

  /** macOS tells of no key that goes up while Command is down, so whatever was down is let go. */
  private noteModifiers(event: KeyboardEvent): void {
    this.fast = event.shiftKey;
    if (event.metaKey) this.keys.clear();
  }

  private turnOrZoom({ key, shiftKey }: KeyboardEvent): boolean {
    const view = this.target.view();
    const [arrow, factor] = [kArrows.get(key), kZoomKeys.get(key)];
    if (!arrow && !factor) return false;
    if (!view) {
      this.target.refused();
      return false;
    }
    if (factor) this.zoomBy(view, factor);
    else if (arrow && shiftKey) this.pan(view, -arrow[0], -arrow[1]);
    else if (arrow) {
      this.turn(view, -arrow[0], -arrow[1], false);
    }
    return true;
  }

  /** The window lost the focus: no key-up will come. */
  releaseAll(): void {
    this.keys.clear();
    this.pointers.clear();
  }

  private pointerDown(event: PointerEvent): void {
    this.canvas.setPointerCapture(event.pointerId);
    this.canvas.focus({ preventScroll: true });
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }

  private pointerMove(event: PointerEvent): void {
    const from = this.pointers.get(event.pointerId);
    if (!from) return;
    const view = this.target.view();
    if (event.buttons === 0 || !view) {
      this.pointers.delete(event.pointerId); // it went up where no event told of it
      if (event.buttons !== 0) this.target.refused();
      return;
    }
    const to = { x: event.clientX, y: event.clientY };
    const height = Math.max(1, this.canvas.clientHeight);
    const dx = (to.x - from.x) / height;
    const dy = (to.y - from.y) / height;
    if (this.pointers.size >= 2) this.pinch(view, event.pointerId, from, to);
    else if ((event.buttons & 6) !== 0 || event.shiftKey) this.pan(view, dx, dy);
    else this.turn(view, dx, dy, event.altKey);
    this.pointers.set(event.pointerId, to);
  }

  /** What is seen follows the pointer, which moves by shares of the canvas's height. */
  private turn(view: View, dx: number, dy: number, alt: boolean): void {
    const looks = !view.orthographic && this.target.isInRoom() !== alt;
    const radPerHeight = looks ? -(view.fovDeg * Math.PI) / 180 : kRadPerHeight;
    this.target.setPose((looks ? look : orbit)(view, dx * radPerHeight, dy * radPerHeight));
  }

  private pan(view: View, dx: number, dy: number): void {
    this.target.setPose(pan(view, dx, dy, heightAtTarget(view)));
  }

  /** Each finger moves the picture by half its way; their distance zooms. */
  private pinch(view: View, id: number, from: Pointer, to: Pointer): void {
    const other = [...this.pointers].find(([key]) => key !== id)?.[1];
    if (!other) return;
    const before = Math.hypot(from.x - other.x, from.y - other.y);
    const after = Math.hypot(to.x - other.x, to.y - other.y);
    if (before > 1 && after > 1) this.zoomBy(view, before / after);
    const moved = this.target.view();
    const height = Math.max(1, this.canvas.clientHeight) * 2;
    if (moved) this.pan(moved, (to.x - from.x) / height, (to.y - from.y) / height);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const view = this.target.view();
    if (!view) {
      this.target.refused();
      return;
    }
    this.zoomBy(view, wheelFactor(event, this.canvas.clientHeight));
  }

  private zoomBy(view: View, factor: number): void {
    if (view.orthographic) this.target.setHalfHeight(view.halfHeight * factor);
    else this.target.setPose(zoom(view, factor, this.target.closestM()));
  }

  private scheduleStep(): void {
    if (this.lastStepMs !== null) return;
    this.lastStepMs = performance.now();
    this.nextFrame((nowMs) => this.step(nowMs));
  }

  private step(nowMs: number): void {
    const view = this.target.view();
    if (this.keys.size === 0 || this.lastStepMs === null || !view) {
      this.lastStepMs = null;
      if (!view && this.keys.size > 0) this.target.refused();
      return;
    }
    const seconds = Math.min(kLongestStepS, Math.max(0, (nowMs - this.lastStepMs) / 1000));
    this.lastStepMs = nowMs;
    const distance = seconds * this.target.flySpeed() * (this.fast ? kFastFactor : 1);
    let [right, up, forward] = [0, 0, 0];
    for (const key of this.keys) {
      const [r, u, f] = kFlyKeys.get(key) ?? [0, 0, 0];
      right += r * distance;
      up += u * distance;
      forward += f * distance;
    }
    this.target.setPose(fly(view, right, up, forward));
    this.nextFrame((next) => this.step(next));
  }
}

/** Metres that the picture's height spans at the target's depth. */
function heightAtTarget(view: View): number {
  if (view.orthographic) return 2 * view.halfHeight;
  const { eye, target } = view;
  const distance = Math.hypot(target.x - eye.x, target.y - eye.y, target.z - eye.z);
  return 2 * distance * Math.tan((view.fovDeg * Math.PI) / 360);
}
