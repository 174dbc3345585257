// Records a video of the camera path, or of the present view: the server draws every frame, the browser encodes them.

import { messageOf } from '../core/format';
import { appended, closeBeside, element } from '../core/dom';
import { download, fileName } from '../core/download';
import { sizeText, type Size } from '../core/size';
import type { CameraPath, View } from '../path/camera_path';
import { reasonOf, type ServerFiles } from '../protocol/server_files';
import { frameCount, inOrder, patiently, problemOf } from '../video/frames';
import { sizesOf } from './picture_card';

export interface RecordActions {
  pictureSize(): Size | null;
  /** Path of a still of this view `timeS` after lights and animations begin; `view`: of another camera. */
  frame(size: Size, timeS: number, view: View | null): string;
}

const kRates: readonly number[] = [15, 24, 30, 60];
const kUsualRate = 30;
const kUsualSeconds = 10;

const kHtml = `
  <dialog id="recording" aria-labelledby="recording-title">
    <h1 id="recording-title">Record a video</h1>
    <p id="recording-of"></p>
    <p id="recording-choice">
      <label>Size <select id="recording-size"></select></label>
      <label>Frames a second <select id="recording-rate"></select></label>
      <label id="recording-length">Duration, s <input id="recording-seconds" type="number" min="0.1" max="3600" step="any" /></label>
    </p>
    <progress id="recording-progress" max="1" value="0" aria-label="Progress of the recording" hidden></progress>
    <p id="recording-said" role="status"></p>
    <p>
      <button id="recording-start" type="button">Record</button>
      <button id="recording-cancel" type="button" hidden>Cancel the recording</button>
      <button id="recording-close" type="button">Close</button>
    </p>
  </dialog>`;

const seconds = (s: number): Promise<void> => new Promise((done) => setTimeout(done, 1000 * s));

export class RecordCard {
  private readonly dialog = appended(kHtml, 'recording', HTMLDialogElement);
  private readonly size = element('recording-size', HTMLSelectElement);
  private readonly rate = element('recording-rate', HTMLSelectElement);
  private readonly length = element('recording-seconds', HTMLInputElement);
  private readonly progress = element('recording-progress', HTMLProgressElement);
  private readonly said = element('recording-said', HTMLElement);
  private sizes: readonly Size[] = [];
  private path: CameraPath | null = null;
  private cancel: AbortController | null = null; // while one is made

  constructor(
    private readonly actions: RecordActions,
    private readonly files: ServerFiles,
    private readonly pathNow: () => CameraPath | null,
  ) {
    closeBeside(this.dialog);
    this.rate.append(...kRates.map((rate) => new Option(String(rate), String(rate), false, rate === kUsualRate)));
    this.length.value = String(kUsualSeconds);
    element('recording-start', HTMLButtonElement).addEventListener('click', () => void this.record());
    element('recording-cancel', HTMLButtonElement).addEventListener('click', () => this.cancel?.abort(new Error('cancelled')));
    element('recording-close', HTMLButtonElement).addEventListener('click', () => this.dialog.close());
  }

  /** A recording goes on while the dialog is closed. */
  toggle(): void {
    if (this.dialog.open) {
      this.dialog.close();
      return;
    }
    if (!this.cancel) this.offer();
    this.dialog.showModal();
  }

  private offer(): void {
    this.path = this.pathNow();
    const shown = this.actions.pictureSize();
    const even = (side: number): number => 2 * Math.max(8, Math.round(side / 2));
    this.sizes = shown ? [{ width: even(shown.width), height: even(shown.height) }, ...sizesOf(shown)] : [];
    this.size.replaceChildren(...this.sizes.map((size, i) => new Option(sizeText(size), String(i))));
    element('recording-of', HTMLElement).textContent = this.path
      ? `The camera follows its path for ${this.path.seconds.toFixed(1)} seconds. The server draws each frame in full.`
      : 'The camera stays where it is. The server draws each frame in full.';
    element('recording-length', HTMLElement).hidden = this.path !== null;
    this.say(shown ? '' : 'There is no picture to record yet.');
  }

  private say(text: string): void {
    this.said.textContent = text;
  }

  private show(recording: boolean): void {
    element('recording-start', HTMLButtonElement).disabled = recording;
    element('recording-cancel', HTMLButtonElement).hidden = this.progress.hidden = !recording;
    for (const control of [this.size, this.rate, this.length]) control.disabled = recording;
  }

  private async record(): Promise<void> {
    const size = this.sizes[Number(this.size.value)];
    const framesPerS = Number(this.rate.value);
    const durationS = this.path?.seconds ?? this.length.valueAsNumber;
    const problem = problemOf(durationS, framesPerS);
    if (!size || problem !== '') {
      this.say(problem || 'There is no picture to record yet.');
      return;
    }
    this.cancel = new AbortController();
    this.show(true);
    try {
      const video = await this.framesOf(size, framesPerS, frameCount(durationS, framesPerS), this.cancel.signal);
      download(video, fileName('webm'));
      this.say(`The video has ${(video.size / 1e6).toFixed(1)} MB.`);
    } catch (error) {
      this.say(`The video was not recorded: ${messageOf(error)}`);
    } finally {
      this.cancel = null;
      this.show(false);
    }
  }

  private async framesOf(size: Size, framesPerS: number, count: number, signal: AbortSignal): Promise<Blob> {
    const { path } = this;
    const { WebmFile } = await import('../video/webm_file');
    const file = await WebmFile.begin(size.width, size.height, framesPerS);
    try {
      await inOrder(
        count,
        async (index) => {
          const timeS = index / framesPerS;
          const address = this.actions.frame(size, timeS, path ? path.at(timeS) : null);
          const answer = await patiently(() => this.files.get(address), seconds);
          if (!answer.ok) throw new Error(await reasonOf(answer));
          return createImageBitmap(await answer.blob());
        },
        async (picture, index) => {
          await file.add(picture, index);
          this.progress.value = (index + 1) / count;
          this.say(`Frame ${index + 1} of ${count}`);
        },
        signal,
      );
    } catch (error) {
      await file.cancel();
      throw error;
    }
    return file.finish();
  }
}
