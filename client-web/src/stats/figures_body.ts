// What the statistics card unfolds to. Fetched when it is first opened.

import { element, make } from '../core/dom';
import { bits, bytes, count, gridText, ms, timeText } from '../core/format';
import { CodecSchema } from '../gen/froxel/v1/common_pb';
import type { FrameDetails, FrameHeader } from '../gen/froxel/v1/server_pb';
import { nameIn } from '../protocol/schema_names';
import { deliveryRows } from './delivery';
import { Details, exposureText, peelText, shadowText, surfacesText } from './details';
import { Graph } from './graph';
import { PassStack } from './pass_stack';
import { kStages, type Figures, type Stats } from './stats';

const kGraphWidth = 274;
const kGraphHeight = 84;

const codecName = ({ parts }: FrameHeader): string => nameIn(CodecSchema, parts[0]?.codec ?? 0);

interface Bar {
  readonly name: string;
  readonly ms: number;
}

/** What the page knows beside its frames. */
export interface PageFacts {
  /** Frames that arrived and were not shown. */
  droppedHere(): number;
  /** When a moved camera shows. */
  cameraText(): string;
}

export class FiguresBody {
  private readonly list = element('stats-list', HTMLElement);
  private readonly values = new Map<string, HTMLElement>();
  private readonly details = new Details();
  private readonly passes = new PassStack();
  private readonly graph = new Graph(element('graph', HTMLElement), kGraphWidth, kGraphHeight);

  constructor(
    private readonly stats: Stats,
    private readonly page: PageFacts,
  ) {
    element('stats-body', HTMLElement).hidden = false;
  }

  showDetails(details: FrameDetails): void {
    this.details.showDetails(details);
  }

  show(figures: Figures): void {
    this.showList(figures);
    this.passes.show(this.stats.passes.shares());
    this.showBars(
      'stats-stages',
      kStages.map((stage) => ({ name: stage, ms: figures.stagesMs[stage] ?? 0 })),
    );
    if (figures.last) this.details.showFrame(figures.last);
    this.graph.show(this.stats.history);
  }

  private showList({ last, ...figures }: Figures): void {
    this.value('Frame interval, ms', 'interval', ms(this.stats.history.intervalMs.at(-1) ?? null));
    const latency = `${ms(figures.latencyP50Ms)} · ${ms(figures.latencyP95Ms)}`;
    this.value('Latency, median · p95, ms', 'latency', latency);
    this.value('Moved camera shows', 'camera', this.page.cameraText());
    this.value('Data rate', '', `${bytes(figures.bytesPerSecond)}/s`);
    if (!last) return;
    this.value('Codec', '', `${codecName(last)} · ${bits(figures.bytesPerSecond * 8)}/s`);
    this.value('Picture, pixels', '', `${last.width} × ${last.height}`);
    for (const { name, value } of deliveryRows(last)) this.value(name, '', value);
    const gpu = timeText(last.gpuUs === undefined ? null : last.gpuUs / 1000);
    this.value('Drawing · encoding, ms', '', `${gpu} · ${ms(last.encodeUs / 1000)}`);
    this.value('Surfaces', '', surfacesText(last));
    this.value('Triangles', '', count(last.triangles));
    this.value('Lights', '', count(last.lightCount));
    const lists = !last.allLights && !last.listsOverflowed;
    const usual = `${last.listMean.toFixed(1)} · ${count(last.listP95)}`;
    this.value('Lights per list, mean · p95', '', lists ? usual : 'all lights');
    this.value('Longest light list', '', lists ? count(last.listLargest) : '–');
    this.value('Cluster grid', '', last.grid ? gridText(last.grid) : '–');
    this.value('Peeled layers · pixels with more', '', peelText(last));
    this.value('Lights with shadows · maps', '', shadowText(last));
    this.value('Metered exposure', '', exposureText(last));
    const dropped = `${count(last.droppedFrames)} · ${count(this.page.droppedHere())}`;
    this.value('Frames dropped, server · page', '', dropped);
  }

  private value(name: string, key: string, text: string): void {
    let value = this.values.get(name);
    if (!value) {
      value = make('dd');
      this.values.set(name, value);
      this.list.append(make('dt', name, key), value);
    }
    value.textContent = text;
  }

  private showBars(id: string, bars: readonly Bar[]): void {
    const list = element(id, HTMLElement);
    const longest = Math.max(...bars.map((bar) => bar.ms), 1e-9);
    while (list.children.length > bars.length) list.lastElementChild?.remove();
    bars.forEach((bar, index) => {
      let item = list.children[index];
      if (!item) {
        item = make('li');
        item.append(make('span'), make('span'));
        list.append(item);
      }
      const [name, value] = item.children;
      if (name) name.textContent = bar.name.replaceAll('_', ' ');
      if (value) value.textContent = ms(bar.ms);
      const fill = Math.max(0, (bar.ms / longest) * 100);
      (item as HTMLElement).style.setProperty('--fill', `${fill.toFixed(1)}%`);
    });
  }
}
