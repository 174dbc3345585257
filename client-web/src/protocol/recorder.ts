// The commands that this page sends, with their times, for a script (script_file.ts). Pure.

import type { ClientBody } from './framing';

/** What a viewer that replays says by itself, or what belongs to one connection or room. */
const kNotRecorded: ReadonlySet<ClientBody['case']> = new Set([
  'hello',
  'ack',
  'ping',
  'pause',
  'requestKeyFrame',
  'requestDepth',
  'requestControl',
  'releaseControl',
  'giveControl',
] as const satisfies ClientBody['case'][]);

/** An hour of moving the camera at 60 commands a second, and some 40 MB. */
const kMost = 216_000;

export interface Recorded {
  readonly atMs: number; // since the recording began
  readonly body: ClientBody;
}

export class Recorder {
  private commands: Recorded[] | null = null;
  private startedAtMs = 0;

  constructor(
    private readonly nowMs: () => number,
    readonly most = kMost,
  ) {}

  get recording(): boolean {
    return this.commands !== null;
  }

  get full(): boolean {
    return this.commands !== null && this.commands.length >= this.most;
  }

  /** `initial` brings a fresh session to where the recording starts. */
  start(initial: readonly ClientBody[]): void {
    this.commands = [];
    this.startedAtMs = this.nowMs();
    for (const body of initial) this.add(body, 0);
  }

  sent(body: ClientBody): void {
    this.add(body, Math.round(this.nowMs() - this.startedAtMs));
  }

  /** Gives what was recorded. */
  stop(): readonly Recorded[] {
    const commands = this.commands ?? [];
    this.commands = null;
    return commands;
  }

  private add(body: ClientBody, atMs: number): void {
    if (!this.commands || this.full || kNotRecorded.has(body.case)) return;
    this.commands.push({ atMs, body });
  }
}
