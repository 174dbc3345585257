// The fold of the statistics card: how well the light lists fit, which grid was chosen and why, what
// this view needs and leaves out, and where the device's memory goes.

import { element, make } from '../core/dom';
import { bytes, count, gridText, percent } from '../core/format';
import type { FrameDetails, FrameHeader } from '../gen/froxel/v1/server_pb';

export interface Row {
  readonly name: string;
  readonly value: string;
}

/** The light lists of a frame. */
export function listRows(header: FrameHeader): Row[] {
  const pairs = header.pairs;
  const rows = [
    { name: 'Loop over', value: header.allLights ? 'all lights' : 'lists' },
    { name: 'List entries', value: count(header.listEntries) },
    { name: 'Clusters', value: count(header.listClusters) },
    { name: '… empty', value: count(header.listEmpty) },
    { name: 'Lists in memory', value: bytes(Number(header.listBytes)) },
  ];
  if (header.listRedraws > 0) {
    rows.push({ name: 'Drawn again', value: `${header.listRedraws} × for longer lists` });
  }
  if (header.listsCapped > 0) {
    const worst = header.listDroppedIrradiance.toPrecision(3);
    rows.push(
      { name: 'Capped lists', value: count(header.listsCapped) },
      { name: '… dropped', value: `${count(header.listDropped)} · at most ${worst} each point` },
    );
  }
  if (!pairs) return rows;
  const share = percent(Number(pairs.contributing), Number(pairs.evaluated));
  return [
    ...rows,
    { name: 'Pairs evaluated', value: count(pairs.evaluated) },
    { name: '… contributing', value: `${count(pairs.contributing)} · ${share}` },
  ];
}

/** Layers peeled of blended surfaces, and pixels that have more. */
export function peelText({ peel }: FrameHeader): string {
  return peel ? `${peel.layers} · ${count(peel.overflowPixels)} px` : '–';
}

/** Lights with shadow maps, and their maps. */
export function shadowText({ shadows }: FrameHeader): string {
  if (!shadows) return '–';
  const kept = shadows.mapsKept > 0 ? `, ${shadows.mapsKept} kept` : '';
  return `${shadows.lights} · ${shadows.maps}${kept}`;
}

/** Whether surfaces were drawn, or are those of the frame before. */
export function surfacesText({ surfacesKept }: FrameHeader): string {
  return surfacesKept ? 'kept' : 'drawn';
}

/** Stops by which the frame metered its own exposure. */
export function exposureText({ meteredEv }: FrameHeader): string {
  if (meteredEv === undefined) return 'fixed';
  return `${meteredEv < 0 ? '−' : '+'}${Math.abs(meteredEv).toFixed(1)} EV`;
}

/** The cluster grid of a frame; none without lights in clusters. */
export function gridRows({ grid }: FrameHeader): Row[] {
  if (!grid) return [];
  const metres = (value: number): string => String(Number(value.toPrecision(3)));
  return [
    { name: grid.automatic ? 'Grid, automatic' : 'Grid, by hand', value: gridText(grid) },
    { name: 'Tile', value: `${grid.tileWidthPx} × ${grid.tileHeightPx} px` },
    { name: 'Depth', value: `${metres(grid.nearM)} to ${metres(grid.farM)} m` },
  ];
}

/** Device memory, largest first, and its sum. */
export function memoryRows({ memory }: FrameDetails): Row[] {
  const sum = memory.reduce((total, use) => total + use.bytes, 0n);
  return [...memory]
    .sort((a, b) => Number(b.bytes - a.bytes))
    .map((use) => ({ name: use.purpose, value: bytes(Number(use.bytes)) }))
    .concat({ name: 'Together', value: bytes(Number(sum)) });
}

export class Details {
  private readonly fold = element('stats-details', HTMLDetailsElement);
  private readonly lists = element('detail-lists', HTMLElement);
  private readonly listWhy = element('detail-list-why', HTMLElement);
  private readonly grid = element('detail-grid', HTMLElement);
  private readonly gridWhy = element('detail-grid-why', HTMLElement);
  private readonly plan = element('detail-plan', HTMLElement);
  private readonly memory = element('detail-memory', HTMLElement);

  showFrame(header: FrameHeader): void {
    if (!this.fold.open) return;
    fill(this.lists, listRows(header));
    fill(this.grid, gridRows(header));
    say(this.listWhy, header.listWhy);
    say(this.gridWhy, header.grid?.why ?? '');
  }

  showDetails(details: FrameDetails): void {
    this.plan.replaceChildren(...details.plan.map((line) => make('li', line)));
    fill(this.memory, memoryRows(details));
  }
}

function fill(list: HTMLElement, rows: readonly Row[]): void {
  const texts = rows.flatMap(({ name, value }) => [name, value]);
  const shown = [...list.children].map(({ textContent }) => textContent);
  // Left alone while equal, so that text can be selected.
  if (shown.length === texts.length && texts.every((text, i) => text === shown[i])) return;
  list.replaceChildren(...rows.flatMap(({ name, value }) => [make('dt', name), make('dd', value)]));
}

function say(line: HTMLElement, text: string): void {
  if (line.textContent !== text) line.textContent = text;
  line.hidden = text === '';
}
