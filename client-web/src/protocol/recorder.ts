// The commands that this page sends, as a script for `froxel load --script`: JSON lines of the
// protocol's own messages with `at_ms`. Pure.

import { create, toJson } from '@bufbuild/protobuf';

import { ClientMessageSchema } from '../gen/froxel/v1/client_pb';
import type { ClientBody } from './framing';

/** What a viewer that replays says by itself, or what belongs to one connection or room. */
const kNotRecorded: ReadonlySet<ClientBody['case']> = new Set([
  'hello',
  'ack',
  'ping',
  'pause',
  'requestKeyFrame',
  'requestControl',
  'releaseControl',
  'giveControl',
] as const satisfies ClientBody['case'][]);

/** An hour of moving the camera at 60 commands a second, and some 40 MB. */
const kMaxLines = 216_000;

export class Recorder {
  private lines: string[] | null = null;
  private startedAtMs = 0;

  constructor(
    private readonly nowMs: () => number,
    readonly maxLines = kMaxLines,
  ) {}

  get recording(): boolean {
    return this.lines !== null;
  }

  get full(): boolean {
    return this.lines !== null && this.lines.length >= this.maxLines;
  }

  /** `initial` brings a fresh session to where the recording starts. */
  start(initial: readonly ClientBody[]): void {
    this.lines = [];
    this.startedAtMs = this.nowMs();
    for (const body of initial) this.add(body, 0);
  }

  sent(body: ClientBody): void {
    this.add(body, Math.round(this.nowMs() - this.startedAtMs));
  }

  /** The script, a line's end after each line. */
  stop(): string {
    const lines = this.lines ?? [];
    this.lines = null;
    return lines.map((line) => `${line}\n`).join('');
  }

  private add(body: ClientBody, atMs: number): void {
    if (!this.lines || this.full || kNotRecorded.has(body.case)) return;
    const message = toJson(ClientMessageSchema, create(ClientMessageSchema, { body }));
    this.lines.push(JSON.stringify({ at_ms: atMs, ...(message as object) }));
  }
}
