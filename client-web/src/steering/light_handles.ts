// Handles of the placed lights over the picture: to choose one, drag it, delete it. A double click
// on the picture places the light that is there.
//
//   drag moves in the view's plane, with shift nearer and farther · arrows do the same · Delete or
//   Backspace removes · Escape goes back to the picture

import { make } from '../core/dom';
import { containedIn, type Rect } from '../core/size';
import { displayColor } from '../core/srgb';
import { findLight, kindName, type PlacedLight } from '../settings/placed_lights';
import type { Settings } from '../settings/settings';
import type { AppState } from '../state/app_state';
import { mayControl } from '../state/room';
import { halfHeightAt } from '../settings/sight';
import { project, unproject, type PicturePoint } from './projection';

export interface HandleActions {
  chooseLight(id: number | null): void;
  editLight(id: number, patch: Partial<PlacedLight>): void;
  removeLight(id: number): void;
  pickLight(at: { x: number; y: number }): void;
}

/** Share of half the picture's height that an arrow key moves a light by. */
const kStep = 0.02;
const kArrows: ReadonlyMap<string, readonly [number, number]> = new Map([
  ['ArrowLeft', [-kStep, 0]],
  ['ArrowRight', [kStep, 0]],
  ['ArrowUp', [0, kStep]],
  ['ArrowDown', [0, -kStep]],
]);

export class LightHandles {
  private readonly handles = new Map<number, HTMLButtonElement>();
  private settings: Settings | null = null; // null: no handles
  private picture: Settings | null = null; // null: nothing to pick in
  private chosen: number | null = null;
  private readonly grabbed = new Map<number, { dx: number; dy: number }>(); // by light id

  constructor(
    private readonly parent: HTMLElement,
    private readonly canvas: HTMLCanvasElement,
    private readonly actions: HandleActions,
  ) {
    new ResizeObserver(() => this.place()).observe(canvas);
  }

  /** Of a double click in the picture. */
  pickAt(event: MouseEvent): void {
    const at = this.pointerAt(event);
    if (this.picture && Math.abs(at.x) <= 1 && Math.abs(at.y) <= 1) this.actions.pickLight(at);
  }

  /** Who only watches a room has none. */
  show({ settings, chosenLight, handles, room }: AppState): void {
    this.picture = mayControl(room) ? settings : null;
    const shown = handles ? this.picture : null;
    if (shown === this.settings && chosenLight === this.chosen) return;
    this.settings = shown;
    this.chosen = chosenLight;
    const lights = shown?.placedLights ?? [];
    const ids = new Set(lights.map(({ id }) => id));
    for (const [id, handle] of this.handles) {
      if (ids.has(id)) continue;
      handle.remove();
      this.handles.delete(id);
    }
    for (const { id } of lights) {
      if (!this.handles.has(id)) this.handles.set(id, this.makeHandle(id));
    }
    this.place();
  }

  private rect(): Rect {
    const { width, height } = this.picture ?? { width: 1, height: 1 };
    return containedIn(this.canvas.getBoundingClientRect(), { width, height });
  }

  private place(): void {
    const { settings } = this;
    if (!settings) return;
    const rect = this.rect();
    for (const light of settings.placedLights) {
      const handle = this.handles.get(light.id);
      if (!handle) continue;
      const at = project(settings, rect.width / rect.height, light.position);
      const within = at !== null && Math.abs(at.x) <= 1 && Math.abs(at.y) <= 1;
      handle.hidden = !within;
      if (!at) continue;
      const x = rect.left + ((at.x + 1) / 2) * rect.width;
      const y = rect.top + ((1 - at.y) / 2) * rect.height;
      handle.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      handle.style.setProperty('--light', displayColor(light.color));
      handle.classList.toggle('chosen', light.id === this.chosen);
      const kind = kindName(light.kind);
      handle.setAttribute('aria-label', `Light ${light.id}, ${kind}`);
    }
  }

  private makeHandle(id: number): HTMLButtonElement {
    const handle = make('button', '', 'handle');
    handle.type = 'button';
    handle.title = `Light ${id}: drag or arrows move it, with Shift nearer and farther; Delete removes it`;
    handle.addEventListener('focus', () => this.actions.chooseLight(id));
    handle.addEventListener('pointerdown', (event) => this.grab(id, handle, event));
    handle.addEventListener('pointermove', (event) => this.drag(id, event));
    for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      handle.addEventListener(type, () => void this.grabbed.delete(id));
    }
    handle.addEventListener('keydown', (event) => this.key(id, event));
    this.parent.append(handle);
    return handle;
  }

  private grab(id: number, handle: HTMLElement, event: PointerEvent): void {
    if (event.button !== 0) return;
    const at = this.pictureAt(id);
    const pointer = this.pointerAt(event);
    if (!at) return;
    handle.setPointerCapture(event.pointerId);
    handle.focus();
    this.grabbed.set(id, { dx: at.x - pointer.x, dy: at.y - pointer.y });
  }

  private drag(id: number, event: PointerEvent): void {
    const grabbed = this.grabbed.get(id);
    const at = this.pictureAt(id);
    if (!grabbed || !at) return;
    if (event.buttons === 0) {
      this.grabbed.delete(id); // it went up where no event told of it
      return;
    }
    const pointer = this.pointerAt(event);
    const to = { x: pointer.x + grabbed.dx, y: pointer.y + grabbed.dy };
    if (event.shiftKey) {
      // Up is away; the light stays on its ray, so the offset to the pointer changes instead.
      this.move(id, { ...at, depth: at.depth * Math.exp(to.y - at.y) });
      this.grabbed.set(id, { dx: at.x - pointer.x, dy: at.y - pointer.y });
    } else {
      this.move(id, { ...to, depth: at.depth });
    }
  }

  private key(id: number, event: KeyboardEvent): void {
    const { key, shiftKey, ctrlKey, metaKey, altKey } = event;
    if (ctrlKey || metaKey || altKey) return; // the browser's: Alt and an arrow go back a page
    const at = this.pictureAt(id);
    const [right, up] = kArrows.get(key) ?? [0, 0];
    if (key === 'Delete' || key === 'Backspace') {
      this.actions.removeLight(id);
      this.canvas.focus({ preventScroll: true });
    } else if (key === 'Escape') this.canvas.focus({ preventScroll: true });
    else if (at && shiftKey && up !== 0) this.move(id, { ...at, depth: at.depth * Math.exp(up) });
    else if (at && kArrows.has(key)) this.move(id, { ...at, x: at.x + right, y: at.y + up });
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  private pictureAt(id: number): PicturePoint | null {
    const light = this.settings && findLight(this.settings.placedLights, id);
    const rect = this.rect();
    return light && this.settings
      ? project(this.settings, rect.width / rect.height, light.position)
      : null;
  }

  private pointerAt(event: MouseEvent): { x: number; y: number } {
    const rect = this.rect();
    return {
      x: ((event.clientX - rect.left) / rect.width) * 2 - 1,
      y: 1 - ((event.clientY - rect.top) / rect.height) * 2,
    };
  }

  private move(id: number, to: PicturePoint): void {
    if (!this.settings || !(halfHeightAt(this.settings, to.depth) > 0)) return;
    const rect = this.rect();
    const position = unproject(this.settings, rect.width / rect.height, to);
    this.actions.editLight(id, { position });
  }
}
