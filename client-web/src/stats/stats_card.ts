// The statistics card: two numbers, and what they unfold to.

import { element } from '../core/dom';
import { ms } from '../core/format';
import { keepOpen, wasOpen } from '../core/kept';
import { Later } from '../core/later';
import type { FrameDetails } from '../gen/froxel/v1/server_pb';
import type { FiguresBody, PageFacts } from './figures_body';
import type { Stats } from './stats';

const kRefreshMs = 250;

export interface StatsCardActions extends PageFacts {
  /** A part of the page could not be fetched. */
  partMissing(): void;
}

export class StatsCard {
  private readonly card = element('stats', HTMLElement);
  private readonly head = element('stats-head', HTMLButtonElement);
  private readonly fps = element('stat-fps', HTMLElement);
  private readonly latencyFigure = element('stat-latency-figure', HTMLElement);
  private readonly latency = element('stat-latency', HTMLElement);
  private readonly body: Later<FiguresBody>;
  private details: FrameDetails | null = null;

  constructor(
    private readonly stats: Stats,
    actions: StatsCardActions,
  ) {
    this.body = new Later(async () => {
      const { FiguresBody } = await import('./figures_body');
      const body = new FiguresBody(stats, actions);
      if (this.details) body.showDetails(this.details);
      return body;
    }, () => actions.partMissing());
    this.head.addEventListener('click', () => this.toggle());
    this.show(wasOpen('figures'));
    setInterval(() => this.refresh(), kRefreshMs);
  }

  /** What it unfolds to is there when it is asked for. */
  prefetch(): void {
    this.body.ahead();
  }

  toggle(): void {
    const open = this.card.classList.contains('closed');
    this.show(open);
    keepOpen('figures', open);
  }

  showDetails(details: FrameDetails): void {
    this.details = details;
    this.body.here?.showDetails(details);
  }

  private show(open: boolean): void {
    this.card.classList.toggle('closed', !open);
    this.head.setAttribute('aria-expanded', String(open));
    if (open) void this.body.want().then(() => this.refresh());
  }

  private refresh(): void {
    const figures = this.stats.figures(performance.now());
    const { isStill, framesPerSecond } = figures;
    this.card.classList.toggle('still', isStill);
    this.fps.textContent = isStill ? 'still' : framesPerSecond.toFixed(framesPerSecond < 10 ? 1 : 0);
    this.latency.textContent = ms(figures.latencyP50Ms);
    this.latencyFigure.hidden = figures.latencyP50Ms === null;
    if (document.hidden || this.card.classList.contains('closed')) return;
    this.body.here?.show(figures);
  }
}
