// Says what is wrong, and how far loading is. Words from the server are set as text, never as HTML.

import { element } from '../core/dom';
import type { AppState } from '../state/app_state';

export interface BannerActions {
  retry(): void;
  dismiss(): void;
  nowMs(): number;
}

const kCountdownMs = 250;
const kInfoMs = 4_000;

export class Banner {
  private readonly box = element('banner', HTMLElement);
  private readonly text = element('banner-text', HTMLElement);
  private readonly retry = element('banner-retry', HTMLButtonElement);
  private readonly close = element('banner-close', HTMLButtonElement);
  private readonly progress = element('progress', HTMLElement);
  private readonly progressText = element('progress-text', HTMLElement);
  private readonly progressBar = element('progress-bar', HTMLProgressElement);
  private state: AppState | null = null;
  private hasPicture = false;
  private expiry: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly actions: BannerActions) {
    this.retry.addEventListener('click', () => this.actions.retry());
    this.close.addEventListener('click', () => this.actions.dismiss());
    setInterval(() => this.countDown(), kCountdownMs);
  }

  /** The first picture is there: from now on trouble shows over it. */
  pictureShown(): void {
    this.hasPicture = true;
    this.progress.hidden = true;
  }

  show(state: AppState): void {
    this.state = state;
    const { link, notice } = state;
    const down = link.phase === 'waiting' || link.phase === 'refused';
    const message = down ? link.reason : (notice?.text ?? '');
    this.box.hidden = message === '' && !(this.hasPicture && link.phase !== 'live');
    this.box.classList.toggle('error', down || notice?.tone === 'error');
    this.text.textContent = message === '' ? 'Connecting…' : message;
    this.retry.hidden = !down;
    this.close.hidden = down || notice === null;
    this.showProgress(state);
    this.countDown();
    clearTimeout(this.expiry);
    if (notice?.tone === 'info') {
      this.expiry = setTimeout(() => this.actions.dismiss(), kInfoMs);
    }
  }

  private showProgress({ link, loading }: AppState): void {
    this.progress.hidden = this.hasPicture || link.phase === 'waiting' || link.phase === 'refused';
    if (loading) {
      this.progressText.textContent = loading.stage;
      this.progressBar.value = loading.fraction;
    } else {
      const live = link.phase === 'live';
      this.progressText.textContent = live ? 'Waiting for the first picture…' : 'Connecting…';
      this.progressBar.removeAttribute('value');
    }
  }

  private countDown(): void {
    const link = this.state?.link;
    if (link?.phase !== 'waiting') return;
    const seconds = Math.max(0, Math.ceil((link.retryAtMs - this.actions.nowMs()) / 1000));
    const next = `Next try in ${seconds} s.`;
    this.text.textContent = `${link.reason} ${next}`;
  }
}
