// Says how it stands, and how far the first picture is. Words from the server are set as text, never as HTML.

import { element } from '../core/dom';
import type { FrameHeader } from '../gen/froxel/v1/server_pb';
import type { Remedy } from '../protocol/connection';
import { kInitialState, type AppState } from '../state/app_state';
import { standingOf, type Standing } from '../state/standing';

export interface BannerActions {
  readonly remedies: Readonly<Record<Remedy['act'], () => void>>;
  /** For how long the picture has shown nothing of what was asked for. */
  lagMs(): number;
  nowMs(): number;
}

const kTickMs = 250;
const kInfoMs = 4_000;
const kErrorMs = 15_000;

/** Only what changes: a screen reader says each change. */
function say(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

export class Banner {
  private readonly canvas = element('view', HTMLCanvasElement);
  private readonly box = element('banner', HTMLElement);
  private readonly text = element('banner-text', HTMLElement);
  private readonly aside = element('banner-aside', HTMLElement);
  private readonly button = element('banner-remedy', HTMLButtonElement);
  private readonly progress = element('progress', HTMLElement);
  private readonly progressText = element('progress-text', HTMLElement);
  private readonly progressBar = element('progress-bar', HTMLProgressElement);
  private state: AppState = kInitialState;
  private remedy: Remedy | null = null;
  private shown: FrameHeader | null = null; // of the picture that is shown
  private expiry: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly actions: BannerActions) {
    this.button.addEventListener('click', () => {
      if (this.remedy) this.actions.remedies[this.remedy.act]();
    });
    setInterval(() => this.draw(), kTickMs);
  }

  /** A picture is there: from now on trouble shows over it. Whether it is the first. */
  pictureShown(header: FrameHeader): boolean {
    const first = this.shown === null;
    this.shown = header;
    if (first) this.draw();
    return first;
  }

  show(state: AppState): void {
    if (state.notice !== this.state.notice) this.expire(state);
    this.state = state;
    this.draw();
  }

  private expire({ notice }: AppState): void {
    clearTimeout(this.expiry);
    if (!notice || notice.stays) return;
    this.expiry = setTimeout(this.actions.remedies.dismiss, notice.tone === 'info' ? kInfoMs : kErrorMs);
  }

  private draw(): void {
    const { shown, actions } = this;
    const moment = { nowMs: actions.nowMs(), hasPicture: shown !== null, lagMs: actions.lagMs(), shown };
    const standing = standingOf(this.state, moment);
    this.canvas.classList.toggle('stale', standing.dims);
    this.remedy = standing.remedy;
    this.box.hidden = standing.text === '';
    this.box.classList.toggle('error', standing.tone === 'error');
    say(this.text, standing.text);
    say(this.aside, standing.aside);
    this.button.hidden = standing.remedy === null;
    say(this.button, standing.remedy?.label ?? '');
    this.showProgress(standing.progress);
  }

  private showProgress(progress: Standing['progress']): void {
    this.progress.hidden = progress === null;
    if (!progress) return;
    say(this.progressText, progress.text);
    if (progress.fraction === null) this.progressBar.removeAttribute('value');
    else this.progressBar.value = progress.fraction;
  }
}
