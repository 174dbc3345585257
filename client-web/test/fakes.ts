// Stand-ins for what a browser gives: a WebSocket, a clock with timers, animation frames.

import { create, fromBinary, toBinary, type MessageInitShape } from '@bufbuild/protobuf';

import { ClientMessageSchema, type ClientMessage } from '../src/gen/froxel/v1/client_pb';
import { Codec } from '../src/gen/froxel/v1/common_pb';
import {
  FrameHeaderSchema,
  ServerMessageSchema,
  type FrameHeader,
  type ServerMessage,
} from '../src/gen/froxel/v1/server_pb';
import type { Environment, Socket } from '../src/protocol/connection';
import type { Refusal } from '../src/protocol/refusal';

export class FakeSocket implements Socket {
  binaryType: BinaryType = 'blob';
  bufferedAmount = 0;
  readyState = 0;
  onopen: Socket['onopen'] = null;
  onmessage: Socket['onmessage'] = null;
  onclose: Socket['onclose'] = null;
  readonly sent: ClientMessage[] = [];
  closedByPage = false;

  constructor(
    readonly url: string,
    readonly subprotocol: string,
  ) {}

  send(data: Parameters<Socket['send']>[0]): void {
    this.sent.push(fromBinary(ClientMessageSchema, data as Uint8Array));
  }

  close(): void {
    this.closedByPage = true;
  }

  accept(): void {
    this.readyState = 1;
    this.onopen?.call(this as unknown as WebSocket, new Event('open'));
  }

  say(body: MessageInitShape<typeof ServerMessageSchema>['body']): void {
    this.deliver(serverMessageBytes(serverMessage(body)).buffer);
  }

  deliver(data: unknown): void {
    const event = new MessageEvent('message', { data });
    this.onmessage?.call(this as unknown as WebSocket, event);
  }

  drop(code: number, reason = ''): void {
    this.readyState = 3;
    const event = Object.assign(new Event('close'), { code, reason, wasClean: false });
    this.onclose?.call(this as unknown as WebSocket, event as CloseEvent);
  }

  /** The commands' names, in order. */
  get said(): (string | undefined)[] {
    return this.sent.map((message) => message.body.case);
  }
}

/** Time that stands still until it is moved. */
export class FakeEnvironment implements Environment {
  readonly codecs = [Codec.JPEG, Codec.VP9];
  readonly sockets: FakeSocket[] = [];
  now = 1000;
  randomValue = 0;
  room = '';
  token = '';
  accessToken = '';
  refusal: Refusal | null = null;
  readonly asked: string[] = [];
  private timers: { at: number; action: () => void }[] = [];
  private asleepMs = 0;

  get socket(): FakeSocket {
    const last = this.sockets.at(-1);
    if (!last) throw new Error('no socket was opened');
    return last;
  }

  openSocket(url: string, subprotocol: string): Socket {
    const socket = new FakeSocket(url, subprotocol);
    this.sockets.push(socket);
    return socket;
  }

  nowMs(): number {
    return this.now;
  }

  wallMs(): number {
    return this.now + this.asleepMs;
  }

  /** The machine sleeps: no timer runs, and only the wall's clock goes on. */
  sleep(ms: number): void {
    this.asleepMs += ms;
  }

  random(): number {
    return this.randomValue;
  }

  hello(): { room: string; resumeToken: string; token: string } {
    return { room: this.room, resumeToken: this.token, token: this.accessToken };
  }

  askRefusal(url: string): Promise<Refusal | null> {
    this.asked.push(url);
    return Promise.resolve(this.refusal);
  }

  after(delayMs: number, action: () => void): () => void {
    const timer = { at: this.now + delayMs, action };
    this.timers.push(timer);
    return () => {
      this.timers = this.timers.filter((other) => other !== timer);
    };
  }

  /** Lets `ms` pass, and then runs what fell due meanwhile, as a browser does for a hidden page. */
  throttle(ms: number): void {
    this.now += ms;
    const due = this.timers.filter(({ at }) => at <= this.now);
    this.timers = this.timers.filter((timer) => !due.includes(timer));
    for (const { action } of due) action();
  }

  /** Lets `ms` pass and runs what falls due, in order. */
  pass(ms: number): void {
    const end = this.now + ms;
    for (;;) {
      const next = this.timers.filter(({ at }) => at <= end).sort((a, b) => a.at - b.at)[0];
      if (!next) break;
      this.timers = this.timers.filter((timer) => timer !== next);
      this.now = next.at;
      next.action();
    }
    this.now = end;
  }
}

/** Animation frames that come when told. */
export class FakeFrames {
  private pending: ((nowMs: number) => void)[] = [];
  readonly next = (action: (nowMs: number) => void): void => void this.pending.push(action);

  get count(): number {
    return this.pending.length;
  }

  run(nowMs = 0): void {
    const due = this.pending;
    this.pending = [];
    for (const action of due) action(nowMs);
  }
}

export function serverMessage(
  body: MessageInitShape<typeof ServerMessageSchema>['body'],
): ServerMessage {
  return create(ServerMessageSchema, body ? { body } : {});
}

export function serverMessageBytes(message: ServerMessage): Uint8Array<ArrayBuffer> {
  return new Uint8Array([0xf7, 2, 0, 0, ...toBinary(ServerMessageSchema, message)]);
}

export function frameHeader(init: MessageInitShape<typeof FrameHeaderSchema>): FrameHeader {
  return create(FrameHeaderSchema, init);
}

/** Lets promises that are already settled run their callbacks. */
export async function settle(): Promise<void> {
  for (let i = 0; i < 8; i += 1) await Promise.resolve();
}
