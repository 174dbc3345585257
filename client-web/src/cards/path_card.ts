// Key frames of a camera path: added, moved, removed, played and scrubbed through.

import { download, fileName } from '../core/download';
import { appended, element, make } from '../core/dom';
import { messageOf } from '../core/format';
import { flythrough, turntable, type Box } from '../path/built_in';
import { CameraPath, problemOf, type PathKeys, type View } from '../path/camera_path';
import {
  kNoPath,
  timeOfKey,
  withKey,
  withLoop,
  withoutKey,
  withSeconds,
  withTime,
  withView,
} from '../path/path_edit';
import { parsePath, pathLine, pathText } from '../path/path_file';
import { PathPlayer } from '../path/path_player';

export interface PathActions {
  /** Null: there is none, somebody else steers, or it is orthographic, which a path cannot follow. */
  perspective(): View | null;
  setView(view: View): void;
  sceneViews(): View[];
  sceneBounds(): Box | null;
  /** Into the address; empty: no path. */
  keepPath(line: string): void;
}

export interface PathPage {
  readonly record: () => void;
  readonly nextFrame: (action: (nowMs: number) => void) => void;
}

/** Links of more characters are cut by servers and chats. */
const kLongestLine = 4_000;
const kBuiltInSeconds = 12;
const kArrowS = 0.1;

const kHtml = `
  <section id="path" class="card" aria-label="Camera path" hidden>
    <div id="path-line">
      <button id="path-play" type="button" class="plain" aria-label="Play the camera path" aria-pressed="false">
        <svg viewBox="0 0 24 24"><path class="play" d="M7 5v14l12-7z" /><path class="pause" d="M7 5v14M17 5v14" /></svg>
      </button>
      <div id="path-track">
        <input id="path-time" type="range" min="0" max="0" step="any" aria-label="Time on the path in seconds" />
        <div id="path-keys" role="group" aria-label="Key frames"></div>
      </div>
      <output id="path-clock" aria-live="off"></output>
      <button id="path-close" type="button" class="plain" aria-label="Close the camera path">×</button>
    </div>
    <p>
      <button id="path-add" type="button" title="Adds the current view as a key frame">Add this view</button>
      <button id="path-replace" type="button" title="Moves the chosen key frame to the current view">Move here</button>
      <button id="path-remove" type="button" title="Removes the chosen key frame">Remove</button>
      <label>Length, s <input id="path-seconds" type="number" min="0.1" max="3600" step="0.1" /></label>
      <label><input id="path-even" type="checkbox" /> Constant speed</label>
      <label><input id="path-loop" type="checkbox" /> Loop</label>
    </p>
    <p>
      <button id="path-turntable" type="button" title="Once around what the view looks at">Turntable</button>
      <button id="path-flythrough" type="button" title="Through the scene’s cameras, or straight ahead">Flythrough</button>
      <button id="path-open" type="button">Open a file</button>
      <button id="path-save" type="button">Save as a file</button>
      <button id="path-record" type="button">Record a video</button>
      <button id="path-clear" type="button">Remove all</button>
      <input id="path-file" type="file" accept=".json,application/json" hidden />
    </p>
    <p id="path-said" role="status"></p>
  </section>`;

export class PathCard {
  private readonly card = appended(kHtml, 'path', HTMLElement);
  private readonly play = element('path-play', HTMLButtonElement);
  private readonly time = element('path-time', HTMLInputElement);
  private readonly clock = element('path-clock', HTMLOutputElement);
  private readonly marks = element('path-keys', HTMLElement);
  private readonly length = element('path-seconds', HTMLInputElement);
  private readonly even = element('path-even', HTMLInputElement);
  private readonly loop = element('path-loop', HTMLInputElement);
  private readonly said = element('path-said', HTMLElement);
  private readonly player: PathPlayer;
  private keys: PathKeys = kNoPath;
  private made: CameraPath | null = null; // null: there is no key
  private chosen: number | null = null;
  private timeS = 0;
  private line: string | null = ''; // what the address was told; null: it is read anew

  constructor(
    private readonly actions: PathActions,
    { record, nextFrame }: PathPage,
  ) {
    element('path-record', HTMLButtonElement).addEventListener('click', record);
    this.player = new PathPlayer({
      view: () => actions.perspective(),
      setView: (view) => actions.setView(view),
      nextFrame,
      moved: (timeS, playing) => this.moved(timeS, playing),
    });
    this.listen();
    this.build();
  }

  toggle(): void {
    this.card.hidden = !this.card.hidden;
    if (this.card.hidden) this.player.stop();
    else element('path-add', HTMLButtonElement).focus();
  }

  /** What a recording follows; null: there is no path. */
  get path(): CameraPath | null {
    return this.made;
  }

  /** A path of the address. */
  read(line: string): void {
    if (line === this.line) return;
    this.line = line;
    this.card.hidden = line === '';
    try {
      this.take(line === '' ? kNoPath : parsePath(line), null);
    } catch (error) {
      this.say(`link: path: ${messageOf(error)}`);
    }
  }

  /** Of another scene, with the address's path: one that no address keeps was the last scene's. */
  sceneShown(line: string): void {
    this.line = null;
    this.read(line);
  }

  private listen(): void {
    const does = (id: string, run: () => void): void =>
      element(id, HTMLButtonElement).addEventListener('click', run);
    does('path-play', () => this.togglePlay());
    does('path-close', () => this.toggle());
    does('path-add', () => this.add());
    does('path-replace', () => this.replace());
    does('path-remove', () => this.remove());
    does('path-turntable', () => this.builtIn((view) => turntable(view, kBuiltInSeconds)));
    does('path-flythrough', () =>
      this.builtIn((view) => flythrough(this.actions.sceneViews(), this.actions.sceneBounds(), view, kBuiltInSeconds)),
    );
    does('path-save', () => this.save());
    does('path-clear', () => this.edit(kNoPath, null));
    const file = element('path-file', HTMLInputElement);
    does('path-open', () => file.click());
    file.addEventListener('change', () => {
      void this.open(file.files?.[0]);
      file.value = '';
    });
    this.time.addEventListener('input', () => this.scrub(this.time.valueAsNumber));
    this.length.addEventListener('change', () => {
      if (this.length.value !== '' && this.length.checkValidity()) {
        this.edit(withSeconds(this.keys, this.length.valueAsNumber), this.chosen);
        return;
      }
      this.say('The length must be a number of seconds from 0.1 to 3600.');
      this.build();
    });
    this.even.addEventListener('change', () =>
      this.edit({ ...this.keys, constantSpeed: this.even.checked }, this.chosen),
    );
    this.loop.addEventListener('change', () => this.edit(withLoop(this.keys, this.loop.checked), this.chosen));
  }

  private togglePlay(): void {
    if (this.player.playing) {
      this.player.stop();
      return;
    }
    if (this.made && this.steers()) this.player.play(this.made, this.timeS);
  }

  /** Whether this viewer may move the camera; else says why not. */
  private steers(): View | null {
    const view = this.actions.perspective();
    if (!view) this.say('A camera path needs a perspective camera that you control.');
    return view;
  }

  private add(): void {
    const view = this.steers();
    if (!view) return;
    try {
      const { path, index } = withKey(this.keys, view, this.timeS);
      this.edit(path, index);
    } catch (error) {
      this.say(messageOf(error));
    }
  }

  private replace(): void {
    const view = this.steers();
    if (view && this.chosen !== null) this.edit(withView(this.keys, this.chosen, view), this.chosen);
  }

  private remove(): void {
    if (this.chosen === null) return;
    const left = this.keys.keys.length - 1;
    this.edit(withoutKey(this.keys, this.chosen), left > 0 ? Math.min(this.chosen, left - 1) : null);
  }

  private builtIn(make: (view: View) => PathKeys): void {
    const view = this.steers();
    if (view) this.edit(make(view), null);
  }

  private save(): void {
    if (this.made) download(new Blob([pathText(this.keys)], { type: 'application/json' }), fileName('path.json'));
  }

  private async open(file: File | undefined): Promise<void> {
    if (!file) return;
    try {
      this.edit(parsePath(await file.text()), null);
    } catch (error) {
      this.say(`${file.name} is not a camera path: ${messageOf(error)}`);
    }
  }

  /** Of this viewer's, if it makes a path. */
  private edit(keys: PathKeys, chosen: number | null): void {
    const problem = keys.keys.length === 0 ? '' : problemOf(keys);
    if (problem !== '') {
      this.say(problem);
      this.build();
      return;
    }
    this.take(keys.keys.length === 0 ? kNoPath : keys, chosen);
    const line = this.made ? pathLine(this.keys) : '';
    const fits = encodeURIComponent(line).length <= kLongestLine;
    this.line = fits ? line : '';
    this.actions.keepPath(this.line);
    if (!fits) this.say(`A path of ${keys.keys.length} key frames is too long for a link. Save it as a file.`);
  }

  private take(keys: PathKeys, chosen: number | null): void {
    this.player.stop();
    this.keys = keys;
    this.made = keys.keys.length === 0 ? null : new CameraPath(keys);
    this.chosen = chosen;
    this.timeS = this.made && chosen !== null ? timeOfKey(this.made, chosen) : 0;
    this.say('');
    this.build();
  }

  private scrub(timeS: number): void {
    this.player.stop();
    if (!this.made || !this.steers()) return;
    this.actions.setView(this.made.at(timeS));
    this.chosen = null;
    this.moved(timeS, false);
    this.showChosen();
  }

  private choose(index: number): void {
    const key = this.keys.keys[index];
    if (!this.made || !key || !this.steers()) return;
    this.player.stop();
    this.chosen = index;
    this.actions.setView(key);
    this.moved(timeOfKey(this.made, index), false);
    this.showChosen();
  }

  private moved(timeS: number, playing: boolean): void {
    this.timeS = timeS;
    this.time.value = String(timeS);
    this.play.setAttribute('aria-pressed', String(playing));
    this.clock.textContent = `${timeS.toFixed(1)} / ${this.keys.seconds.toFixed(1)} s`;
  }

  private say(text: string): void {
    this.said.textContent = text;
  }

  private build(): void {
    const { made, keys } = this;
    this.time.max = String(keys.seconds);
    this.length.value = made ? String(Number(keys.seconds.toFixed(2))) : '';
    this.even.checked = keys.constantSpeed;
    this.loop.checked = keys.loop;
    const empty = made === null;
    for (const control of [this.play, this.time, this.length, this.even, this.loop]) control.disabled = empty;
    for (const id of ['path-save', 'path-record', 'path-clear']) element(id, HTMLButtonElement).disabled = empty;
    const focused = [...this.marks.children].findIndex((mark) => mark === document.activeElement);
    this.marks.replaceChildren(...(made ? keys.keys.map((_, index) => this.markOf(made, index)) : []));
    const again = this.marks.children[focused];
    if (again instanceof HTMLElement) again.focus();
    this.moved(Math.min(this.timeS, keys.seconds), this.player.playing);
    this.showChosen();
  }

  private showChosen(): void {
    for (const [index, mark] of [...this.marks.children].entries()) {
      mark.setAttribute('aria-pressed', String(index === this.chosen));
    }
    for (const id of ['path-replace', 'path-remove']) element(id, HTMLButtonElement).disabled = this.chosen === null;
  }

  /** A key on the time line: a click goes there, a drag and the arrow keys move it in time. */
  private markOf(made: CameraPath, index: number): HTMLButtonElement {
    const mark = make('button', String(index + 1), 'path-key');
    mark.type = 'button';
    const timeS = timeOfKey(made, index);
    mark.style.left = `${this.keys.seconds > 0 ? (100 * timeS) / this.keys.seconds : 0}%`;
    const words = `Key frame ${index + 1} at ${timeS.toFixed(2)} s`;
    mark.setAttribute('aria-label', words);
    mark.title = this.keys.constantSpeed ? words : `${words}: drag it, or press ← or →, to move it in time`;
    mark.addEventListener('click', () => this.choose(index));
    if (this.keys.constantSpeed) return mark;
    mark.addEventListener('keydown', (event) => {
      const by = event.key === 'ArrowRight' ? kArrowS : event.key === 'ArrowLeft' ? -kArrowS : 0;
      if (by === 0) return;
      event.preventDefault();
      this.edit(withTime(this.keys, index, timeS + by), index);
    });
    mark.addEventListener('pointerdown', (event) => this.drag(mark, index, event));
    return mark;
  }

  private drag(mark: HTMLButtonElement, index: number, { pointerId, clientX }: PointerEvent): void {
    const { width } = this.marks.getBoundingClientRect();
    const { seconds } = this.keys;
    const from = this.keys.keys[index]?.atS ?? 0;
    const timeAt = (event: PointerEvent): number => from + ((event.clientX - clientX) / width) * seconds;
    mark.setPointerCapture(pointerId);
    mark.onpointermove = (event) => {
      mark.style.left = `${(100 * Math.max(0, Math.min(seconds, timeAt(event)))) / Math.max(seconds, 1e-9)}%`;
    };
    mark.onpointerup = (event) => {
      mark.onpointermove = mark.onpointerup = null;
      if (Math.abs(event.clientX - clientX) > 2) this.edit(withTime(this.keys, index, timeAt(event)), index);
      else this.choose(index); // a tap right after a drag is no click
    };
    mark.onpointercancel = () => this.build();
  }
}
