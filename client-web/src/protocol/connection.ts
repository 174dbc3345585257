// One viewer's connection: WebSocket, Hello, reconnects. Knows nothing of settings or pictures.

import type { Codec } from '../gen/froxel/v1/common_pb';
import type { ServerMessage } from '../gen/froxel/v1/server_pb';
import { backoffMs } from './backoff';
import {
  decodeBinary,
  encodeCommand,
  FramingError,
  kProtocolMajor,
  kProtocolMinor,
  kSubprotocol,
  type ClientBody,
  type CodedDepth,
  type Frame,
} from './framing';
import { announced, type Refusal } from './refusal';

/** How it is with the connection. */
export type Link =
  | { readonly phase: 'connecting' }
  | { readonly phase: 'greeting' } // open, Welcome not yet there
  | { readonly phase: 'live' }
  | { readonly phase: 'waiting'; readonly reason: string; readonly retryAtMs: number }
  // Trying again by itself is pointless; the remedy, if any, is what a viewer may do.
  | { readonly phase: 'refused'; readonly reason: string; readonly remedy: Remedy | null };

/** What helps, as a button. */
export interface Remedy {
  readonly label: string;
  readonly act: 'connect' | 'reload' | 'dismiss' | 'stay';
}

export interface ConnectionEvents {
  link(link: Link): void;
  message(message: ServerMessage): void;
  frame(frame: Frame, bytes: number): void;
  depth(depth: CodedDepth, bytes: number): void;
  /** A command that has left, whatever it was. */
  sent?(body: ClientBody): void;
  /** The server lets nobody in who knows none of its tokens. */
  tokenWanted(): void;
  /** Something from the server could not be read; the connection goes on. */
  problem(text: string): void;
}

/** The part of WebSocket that is used. */
export type Socket = Pick<
  WebSocket,
  'binaryType' | 'bufferedAmount' | 'close' | 'onclose' | 'onmessage' | 'onopen' | 'readyState' | 'send'
>;

export interface Environment {
  openSocket(url: string, subprotocol: string): Socket;
  nowMs(): number; // monotonic; may stand while the machine sleeps
  wallMs(): number; // goes on then, and may jump
  random(): number; // [0, 1)
  /** What Hello says besides the version: which room, which lost session to take up, who asks. */
  hello(): { readonly room: string; readonly resumeToken: string; readonly token: string };
  /** Why the server declines a socket at this URL; null: it does not, or nobody knows. */
  askRefusal(url: string): Promise<Refusal | null>;
  after(delayMs: number, action: () => void): () => void; // returns how to cancel
  readonly codecs: readonly Codec[]; // that the page decodes
}

/** A connection that lived this long was a good one: the next delay starts small again. */
const kStableMs = 5_000;
const kPingEveryMs = 5_000;
/** Nothing from the server for so long, in spite of pings: the way is broken. */
const kSilenceMs = 15_000;
/** A timer that comes so late was held up by sleep, or by a browser that rests hidden pages. */
const kLateMs = 5_000;
/** A server that is there answers within this to whoever comes back. */
const kProbeMs = 800;
const kOpen = 1;
const kTokenRefused = 4003;
const kResting = 4011;

const connect = (label: string): Remedy => ({ label, act: 'connect' });

interface End {
  readonly reason: string;
  readonly remedy: Remedy;
}

/** Closes after which only a viewer can go on. */
const kEnds: Readonly<Record<number, End>> = {
  1008: {
    reason: 'The server closed this connection: too many messages, too many refused messages, or no greeting in time.',
    remedy: connect('Connect again'),
  },
  1009: {
    reason: 'The server closed this connection: a message was too large.',
    remedy: connect('Connect again'),
  },
  4001: {
    reason: 'This page and the server have different versions.',
    remedy: { label: 'Reload', act: 'reload' },
  },
  4003: { reason: 'This server requires a token.', remedy: connect('Enter a token') },
  4009: { reason: 'This view moved to another tab or window.', remedy: connect('Show it here') },
  4011: {
    reason: 'Nobody watched this view for a while, so another viewer got its place.',
    remedy: connect('Go on'),
  },
};

/** Closes after which the page tries again by itself. */
const kPauses: Readonly<Record<number, string>> = {
  4008: 'Your connection is too slow for this view. A smaller window takes less.',
  4010: 'The server is shutting down.',
  4029: 'All places on this server are in use. One becomes free when a viewer leaves.',
  4030: 'This server cannot draw for more viewers now. There is room when a viewer leaves or pauses.',
  4031: 'Your address or token has the maximum number of open views here. Close one of them to make room.',
  4032: 'All places in this room are in use. One becomes free when a viewer leaves.',
  4033: 'This server has no memory for another view. Memory becomes free when a viewer leaves.',
  4050: 'The server lost its graphics device.',
};

export class Connection {
  private socket: Socket | null = null;
  private seq = 0n;
  private attempt = 0;
  private openedAtMs = 0;
  private heardAtMs = 0;
  private at = ''; // the newest socket's URL
  private refuge = ''; // another server's, if that was the last one to answer
  private lostToken = ''; // a session that no server has any more
  private resting = false; // the server took the place back since nobody watched
  private waiting = false; // for the next try
  private cancelTimer: () => void = () => undefined;
  private cancelLeave: () => void = () => undefined;

  constructor(
    private readonly url: string,
    private readonly events: ConnectionEvents,
    private readonly env: Environment,
  ) {}

  open(url = this.refuge || this.url): void {
    this.cancelTimer();
    this.cancelLeave();
    this.resting = this.waiting = false;
    this.openedAtMs = 0;
    this.at = url;
    this.events.link({ phase: 'connecting' });
    const { room, resumeToken } = this.env.hello();
    const resumable = resumeToken === this.lostToken ? '' : resumeToken;
    const target = announced(url, room, resumable);
    const socket = this.env.openSocket(target, kSubprotocol);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => this.opened(socket);
    socket.onmessage = (event: MessageEvent) => this.received(event.data);
    socket.onclose = (event) => {
      const declined = socket === this.socket && this.openedAtMs === 0;
      this.closed(socket, event.code);
      if (declined) void this.explain(target, resumable);
    };
    this.socket = socket;
  }

  /** Somebody is here again: a view whose place was given away comes back. */
  wake(): void {
    if (this.resting) this.open();
  }

  /** The page is seen again, or the network is back: what was lost meanwhile is not waited for. */
  back(): void {
    if (this.resting || this.waiting) this.open();
    else if (this.socket && this.openedAtMs > 0) this.probe(this.socket);
  }

  /**
   * The server goes down: goes to `url` (empty: the same address, where a proxy knows another
   * server) at a random time in the first half of the deadline, so that not all go at once.
   */
  leave(deadlineMs: number, url: string): void {
    this.cancelLeave();
    this.cancelLeave = this.env.after((this.env.random() * deadlineMs) / 2, () => {
      const before = this.socket;
      this.open(url || undefined);
      before?.close();
    });
  }

  /** Bytes that wait to leave this machine. */
  get backlogBytes(): number {
    return this.socket?.bufferedAmount ?? 0;
  }

  /** Sends a command and returns its sequence number; null while there is no open connection. */
  send(body: ClientBody): bigint | null {
    if (this.socket?.readyState !== kOpen) return null;
    this.seq += 1n;
    this.socket.send(encodeCommand(this.seq, this.env.nowMs(), body));
    this.events.sent?.(body);
    return this.seq;
  }

  private opened(socket: Socket): void {
    if (socket !== this.socket) return;
    this.seq = 0n;
    this.refuge = this.at === this.url ? '' : this.at;
    this.openedAtMs = this.heardAtMs = this.env.nowMs();
    this.events.link({ phase: 'greeting' });
    const hello = { protocolMajor: kProtocolMajor, protocolMinor: kProtocolMinor };
    const codecs = [...this.env.codecs];
    const wanted = { ...hello, ...this.env.hello(), codecs };
    this.send({ case: 'hello', value: { ...wanted, clientName: 'froxel web client' } });
    this.keepAlive(socket);
  }

  private received(data: unknown): void {
    this.heardAtMs = this.env.nowMs();
    try {
      if (!(data instanceof ArrayBuffer)) throw new FramingError('a text message from the server');
      const received = decodeBinary(data);
      if (received.kind === 'frame') this.events.frame(received.frame, data.byteLength);
      else if (received.kind === 'depth') this.events.depth(received.depth, data.byteLength);
      else this.events.message(received.message);
    } catch (error) {
      if (!(error instanceof FramingError)) throw error;
      this.events.problem(error.message);
    }
  }

  private keepAlive(socket: Socket): void {
    const dueMs = this.env.wallMs() + kPingEveryMs;
    this.cancelTimer = this.env.after(kPingEveryMs, () => {
      if (socket !== this.socket) return;
      if (this.env.wallMs() - dueMs > kLateMs) {
        this.probe(socket);
        return;
      }
      if (this.env.nowMs() - this.heardAtMs > kSilenceMs) {
        // close() would wait for an answer that never comes; the browser finishes it later.
        socket.close();
        this.closed(socket, 1006);
        return;
      }
      this.send({ case: 'ping', value: {} });
      this.keepAlive(socket);
    });
  }

  /** Asks whether anybody is there; if not, opens another connection without waiting for more. */
  private probe(socket: Socket): void {
    this.cancelTimer();
    const askedMs = this.env.nowMs();
    this.send({ case: 'ping', value: {} });
    this.cancelTimer = this.env.after(kProbeMs, () => {
      if (socket !== this.socket) return;
      if (this.heardAtMs >= askedMs) {
        this.keepAlive(socket);
        return;
      }
      this.open();
      socket.close();
    });
  }

  private closed(socket: Socket, code: number): void {
    if (socket !== this.socket) return; // an older one that the browser closes late
    this.cancelTimer();
    this.cancelLeave();
    this.socket = null;
    const now = this.env.nowMs();
    const end = kEnds[code];
    if (end) {
      this.events.link({ phase: 'refused', ...end });
      if (code === kTokenRefused) this.events.tokenWanted();
      this.resting = code === kResting;
      this.openedAtMs = 0;
      return;
    }
    if (this.openedAtMs > 0 && now - this.openedAtMs >= kStableMs) this.attempt = 0;
    this.openedAtMs = 0;
    const delay = backoffMs(this.attempt, () => this.env.random());
    this.attempt += 1;
    this.wait(delay, kPauses[code] ?? 'No connection to the server.');
  }

  private wait(delayMs: number, reason: string): void {
    this.cancelTimer();
    this.waiting = true;
    this.events.link({ phase: 'waiting', reason, retryAtMs: this.env.nowMs() + delayMs });
    // This page's own server may be gone for good, or be the only one that comes back: in turns.
    const next = this.attempt % 2 === 1 ? undefined : this.url;
    this.cancelTimer = this.env.after(delayMs, () => this.open(next));
  }

  /** A socket was declined: says why, and waits for as long as it is told to. */
  private async explain(target: string, resumable: string): Promise<void> {
    const attempt = this.attempt;
    const refusal = await this.env.askRefusal(target);
    if (!refusal || this.socket !== null || this.attempt !== attempt) return;
    if (resumable !== '') {
      this.lostToken = resumable; // no server has that session any more: a new one
      this.open(this.at);
      return;
    }
    const delay = refusal.retryAfterMs * (1 + this.env.random());
    this.wait(delay, kPauses[refusal.closeCode] ?? `The server has no place for you now: ${refusal.reason}.`);
  }
}
