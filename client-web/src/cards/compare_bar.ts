// A comparison over the picture: the divider, what each side took, and how far they are apart.

import { element } from '../core/dom';
import { count, ms, percent } from '../core/format';
import { containedIn } from '../core/size';
import { Refinement } from '../gen/froxel/v1/common_pb';
import type { Compared, FrameHeader, PassTime } from '../gen/froxel/v1/server_pb';
import type { AppState } from '../state/app_state';
import { mayControl } from '../state/room';

type Settings = NonNullable<AppState['settings']>;
type How = Pick<Settings, 'compare' | 'compareSplit' | 'compareHeatMap'>;

export interface CompareActions {
  edit(patch: Partial<How>): void;
}

const kHtml = `
  <section id="compare" aria-label="Comparison" hidden>
    <div id="compare-line" aria-hidden="true"></div>
    <input id="compare-split" type="range" min="0" max="1" step="0.005" aria-label="Divider of the comparison" />
    <div id="compare-figures" class="card">
      <p id="compare-left"><span></span><b></b><small></small></p>
      <div id="compare-tools">
        <label><input id="compare-heat" type="checkbox" /> Heat map</label>
        <button id="compare-end" type="button">End</button>
      </div>
      <p id="compare-right"><span></span><b></b><small></small></p>
      <p id="compare-difference"></p>
    </div>
    <p id="compare-said" class="unseen" role="status"></p>
  </section>`;

/** How often figures change on the page, so that people can read them. */
const kFiguresMs = 250;

const us = (value: number | undefined): number | null => (value === undefined ? null : value / 1000);

/** "gbuffer 0.90 · lighting 3.20" */
export const passesText = (passes: readonly Pick<PassTime, 'name' | 'gpuUs'>[]): string =>
  passes.map(({ name, gpuUs }) => `${name.replaceAll('_', ' ')} ${ms(us(gpuUs))}`).join(' · ');

/** "light cutoff 0.02, list cap 8" of light_cutoff:0.02,list_cap:8. */
export const rightText = (compare: string): string =>
  compare.replaceAll(':', ' ').replaceAll('_', ' ').replaceAll(',', ', ');

const colour = (rgb: number): string => `#${rgb.toString(16).padStart(6, '0')}`;

/** How far the pictures of `pixels` pixels are apart. */
export function differenceText(compared: Compared, pixels: number): string {
  const { differing, max, rmse, flip, first, promised } = compared;
  if (differing === 0n) return `Equal, ${count(pixels)} pixels compared`;
  const parts = [
    `${count(differing)} of ${count(pixels)} pixels differ (${percent(Number(differing), pixels)})`,
    `by at most ${Math.round(255 * max)}/255`,
    `RMSE ${rmse.toPrecision(3)}`,
    flip === undefined ? 'FLIP when the view rests' : `FLIP ${flip.toPrecision(3)}`,
  ];
  const where = first ? `the first is (${first.x}, ${first.y}): ${colour(first.left)} and ${colour(first.right)}` : '';
  return `${promised ? 'They should be equal: ' : ''}${parts.join(', ')}${where && `; ${where}`}`;
}

/** The bar, behind the picture's other controls. */
function sectionIn(canvas: HTMLCanvasElement): HTMLElement {
  canvas.parentElement?.insertAdjacentHTML('beforeend', kHtml);
  return element('compare', HTMLElement);
}

export class CompareBar {
  private readonly bar = sectionIn(element('view', HTMLCanvasElement));
  private readonly split = element('compare-split', HTMLInputElement);
  private readonly line = element('compare-line', HTMLElement);
  private readonly left = element('compare-left', HTMLElement);
  private readonly right = element('compare-right', HTMLElement);
  private readonly difference = element('compare-difference', HTMLElement);
  private readonly said = element('compare-said', HTMLElement);
  private shown: (How & { readonly width: number; readonly height: number }) | null = null;
  private figuresMs = -Infinity;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    actions: CompareActions,
    private readonly nowMs: () => number,
  ) {
    this.split.addEventListener('input', () => actions.edit({ compareSplit: Number(this.split.value) }));
    element('compare-heat', HTMLInputElement).addEventListener('change', ({ target }) => {
      if (target instanceof HTMLInputElement) actions.edit({ compareHeatMap: target.checked });
    });
    element('compare-end', HTMLButtonElement).addEventListener('click', () => {
      actions.edit({ compare: '', compareHeatMap: false });
      canvas.focus({ preventScroll: true });
    });
    window.addEventListener('resize', () => this.place());
  }

  show({ settings, room }: AppState): void {
    this.bar.hidden = settings === null || settings.compare === '';
    this.shown = this.bar.hidden ? null : settings;
    if (!this.shown) return;
    this.bar.inert = !mayControl(room);
    this.split.value = String(this.shown.compareSplit);
    const share = `${Math.round(100 * this.shown.compareSplit)} %`;
    this.split.setAttribute('aria-valuetext', `${share} left, the rest with ${rightText(this.shown.compare)}`);
    element('compare-heat', HTMLInputElement).checked = this.shown.compareHeatMap;
    this.place();
  }

  /** A frame was painted. */
  painted(header: FrameHeader): void {
    const { compared } = header;
    if (!compared || !this.shown) return;
    const rests = header.refinement !== Refinement.INTERACTIVE;
    if (!rests && this.nowMs() - this.figuresMs < kFiguresMs) return;
    this.figuresMs = this.nowMs();
    const text = differenceText(compared, header.width * header.height);
    this.fillSide(this.left, 'Left: as set', compared.leftUs, header.gpuUs, header.passes);
    this.fillSide(this.right, `Right: ${rightText(this.shown.compare)}`, compared.rightUs, compared.rightGpuUs, compared.rightPasses);
    this.difference.textContent = text;
    if (rests) this.said.textContent = text;
  }

  private fillSide(
    side: HTMLElement,
    name: string,
    wholeUs: number,
    gpuUs: number | undefined,
    passes: readonly PassTime[],
  ): void {
    const [title, time, parts] = side.children;
    if (title) title.textContent = name;
    if (time) time.textContent = `${ms(wholeUs / 1000)} ms${gpuUs === undefined ? '' : `, GPU ${ms(gpuUs / 1000)} ms`}`;
    if (parts) parts.textContent = passesText(passes);
  }

  /** Over the picture, as wide as it is. */
  private place(): void {
    if (!this.shown) return;
    const { compareSplit, compareHeatMap } = this.shown;
    const rect = containedIn(this.canvas.getBoundingClientRect(), this.shown);
    for (const part of [this.split, this.line]) part.hidden = compareHeatMap;
    // A range's thumb stays within it: half of one beyond each side, so that its middle reaches the edges.
    const { style } = this.bar;
    style.setProperty('--left', `${rect.left}px`);
    style.setProperty('--top', `${rect.top}px`);
    style.setProperty('--width', `${rect.width}px`);
    style.setProperty('--height', `${rect.height}px`);
    style.setProperty('--split', String(compareSplit));
  }
}
