// What the statistics card shows, gathered from painted frames. No DOM, no clock of its own.

import { SampleWindow } from '../core/sample_window';
import type { FrameHeader } from '../gen/froxel/v1/server_pb';
import { InputLatency, RateMeter } from './latency';
import { PassMeter } from './pass_meter';

const kRateSpanMs = 2_000;
const kStageSamples = 64;
const kHistory = 150;
/** A longer pause is a still picture, not a slow one: the server sends only what changed. */
const kIdleMs = 2_000;
/** Fewer say little of the slowest. */
const kTellingSamples = 20;
/** After so long without a command, the latency of the last ones tells nothing of now. */
const kOldMs = 10_000;

/** The way from a command to its picture. "network" is what the other stages leave of the whole. */
export const kStages = [
  'queue',
  'render',
  'encode wait',
  'encode',
  'send wait',
  'network',
  'decode',
] as const;
export type Stage = (typeof kStages)[number];

export interface Figures {
  readonly framesPerSecond: number;
  /** Nothing was asked for that is not shown, and no picture has come for a while. */
  readonly isStill: boolean;
  readonly bytesPerSecond: number;
  readonly latencyP50Ms: number | null;
  readonly latencyP95Ms: number | null;
  readonly stagesMs: Readonly<Record<Stage, number | null>>;
  readonly last: FrameHeader | null;
}

export interface InputToPicture {
  readonly p50Ms: number;
  readonly p95Ms: number;
}

export interface History {
  readonly timeS: number[];
  readonly intervalMs: (number | null)[];
  readonly latencyMs: (number | null)[];
}

export class Stats {
  readonly history: History = { timeS: [], intervalMs: [], latencyMs: [] };
  readonly passes = new PassMeter();
  private readonly frames = new RateMeter(kRateSpanMs);
  private readonly bytes = new RateMeter(kRateSpanMs);
  private readonly latency = new InputLatency();
  private readonly stages = new Map(
    kStages.map((stage) => [stage, new SampleWindow(kStageSamples)]),
  );
  private last: FrameHeader | null = null;
  private lastPaintMs: number | null = null;
  private lastSampleMs = -Infinity;

  received(bytes: number, nowMs: number): void {
    this.bytes.add(nowMs, bytes);
  }

  /** A command was sent that a picture is to show. */
  asked(seq: bigint, nowMs: number): void {
    this.latency.asked(seq, nowMs);
  }

  /** The state after commands up to this one was told, and whether it is another one. */
  answered(seq: bigint, changed: boolean): void {
    this.latency.answered(seq, changed);
  }

  /** A command was refused: no picture will show it. */
  refused(): void {
    this.latency.refused();
  }

  /** For how long no picture has shown any of what was asked for. */
  lagMs(nowMs: number): number {
    return this.latency.lagMs(nowMs);
  }

  painted(header: FrameHeader, decodeMs: number, nowMs: number): void {
    this.frames.add(nowMs, 1);
    this.last = header;
    this.passes.add(header);
    const total = this.latency.painted(header.appliedSeq, header.appliedClientTimeUs, nowMs);
    if (total !== null) {
      this.addStages(header, decodeMs, total);
      this.lastSampleMs = nowMs;
    }
    const pause = this.lastPaintMs === null ? Infinity : nowMs - this.lastPaintMs;
    const interval = pause < kIdleMs ? pause : null;
    this.lastPaintMs = nowMs;
    const { timeS, intervalMs, latencyMs } = this.history;
    timeS.push(nowMs / 1000);
    intervalMs.push(interval);
    latencyMs.push(total);
    if (timeS.length > kHistory) for (const row of [timeS, intervalMs, latencyMs]) row.shift();
  }

  /** A new connection: its frames and commands count from 1 again. */
  restart(): void {
    this.latency.restart();
    this.lastPaintMs = null;
  }

  /** From input to picture; null where too few commands of late tell. */
  inputToPicture(nowMs: number): InputToPicture | null {
    const { window } = this.latency;
    if (nowMs - this.lastSampleMs >= kOldMs || window.count < kTellingSamples) return null;
    const [p50Ms, p95Ms] = [window.percentile(0.5), window.percentile(0.95)];
    return p50Ms === null || p95Ms === null ? null : { p50Ms, p95Ms };
  }

  figures(nowMs: number): Figures {
    const median = ([stage, window]: [Stage, SampleWindow]): [Stage, number | null] => [
      stage,
      window.percentile(0.5),
    ];
    const told = nowMs - this.lastSampleMs < kOldMs ? this.latency.window : null;
    return {
      framesPerSecond: this.frames.perSecond(nowMs),
      isStill: this.lastPaintMs !== null && nowMs - this.lastPaintMs >= kIdleMs && this.lagMs(nowMs) === 0,
      bytesPerSecond: this.bytes.perSecond(nowMs),
      latencyP50Ms: told?.percentile(0.5) ?? null,
      latencyP95Ms: told?.percentile(0.95) ?? null,
      stagesMs: Object.fromEntries([...this.stages].map(median)) as Figures['stagesMs'],
      last: this.last,
    };
  }

  private addStages(header: FrameHeader, decodeMs: number, totalMs: number): void {
    const server = {
      queue: header.queueUs / 1000,
      render: header.renderUs / 1000,
      'encode wait': header.encodeWaitUs / 1000,
      encode: header.encodeUs / 1000,
      'send wait': header.sendWaitUs / 1000,
    };
    const serverMs = Object.values(server).reduce((sum, ms) => sum + ms, 0);
    const all = { ...server, network: totalMs - serverMs - decodeMs, decode: decodeMs };
    for (const stage of kStages) this.stages.get(stage)?.push(all[stage]);
  }
}
