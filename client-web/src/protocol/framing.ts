// How messages lie in WebSocket messages; protocol/README.md is the specification.
//
//   frame           0xF7 0x01 length(u16 LE)  FrameHeader[length]  encoded bytes…
//   server message  0xF7 0x02 0x0000          ServerMessage…
//
// A client's binary message is a bare ClientMessage.

import { create, fromBinary, toBinary, type MessageInitShape } from '@bufbuild/protobuf';

import { ClientMessageSchema } from '../gen/froxel/v1/client_pb';
import {
  FrameHeaderSchema,
  ServerMessageSchema,
  type FrameHeader,
  type ServerMessage,
} from '../gen/froxel/v1/server_pb';

export const kSubprotocol = 'froxel.v1';
export const kProtocolMajor = 1;
export const kProtocolMinor = 2;

const kMagic = 0xf7;
const kKindFrame = 1;
const kKindServerMessage = 2;
const kPrefixBytes = 4;
const kMaxHeaderBytes = 4096;

/** A command, as what a client's message is made of. */
export type ClientBody = NonNullable<MessageInitShape<typeof ClientMessageSchema>['body']>;

/** A message that is not what the protocol says; the text is one line for a person. */
export class FramingError extends Error {}

export interface Frame {
  readonly header: FrameHeader;
  /** All parts' encoded bytes; a view into the received message. */
  readonly payload: Uint8Array<ArrayBuffer>;
}

export type Received =
  | { readonly kind: 'frame'; readonly frame: Frame }
  | { readonly kind: 'message'; readonly message: ServerMessage };

/** Decodes one binary WebSocket message from the server. Throws FramingError. */
export function decodeBinary(buffer: ArrayBuffer): Received {
  const bytes = new Uint8Array(buffer);
  if (bytes.length < kPrefixBytes) {
    throw new FramingError(`server message of ${bytes.length} bytes; it starts with a prefix of 4`);
  }
  const [magic, kind] = bytes;
  if (magic !== kMagic) throw new FramingError(`server message starts with byte ${magic}, not 247`);
  const length = new DataView(buffer).getUint16(2, true);
  if (kind === kKindFrame) return { kind: 'frame', frame: decodeFrame(bytes, length) };
  if (kind === kKindServerMessage && length === 0) {
    const body = bytes.subarray(kPrefixBytes);
    const message = parse('ServerMessage', () => fromBinary(ServerMessageSchema, body));
    return { kind: 'message', message };
  }
  throw new FramingError(`server message of kind ${kind} with a header of ${length} bytes`);
}

function decodeFrame(bytes: Uint8Array<ArrayBuffer>, length: number): Frame {
  const rest = bytes.subarray(kPrefixBytes);
  if (length === 0 || length > kMaxHeaderBytes || length > rest.length) {
    throw new FramingError(`frame header of ${length} bytes in ${rest.length}`);
  }
  const head = rest.subarray(0, length);
  const header = parse('FrameHeader', () => fromBinary(FrameHeaderSchema, head));
  const payload = rest.subarray(length);
  let end = 0;
  for (const part of header.parts) {
    if (part.offset !== end) {
      throw new FramingError(`frame: a part starts at byte ${part.offset}, not at ${end}`);
    }
    end += part.length;
  }
  if (end !== payload.length) {
    throw new FramingError(`frame: parts cover ${end} bytes of ${payload.length}`);
  }
  return { header, payload };
}

function parse<T>(name: string, decode: () => T): T {
  try {
    return decode();
  } catch {
    throw new FramingError(`not a ${name}`);
  }
}

/** One command as a binary WebSocket message. `nowMs` is the client's monotonic clock. */
export function encodeCommand(seq: bigint, nowMs: number, body: ClientBody): Uint8Array {
  const clientTimeUs = BigInt(Math.round(nowMs * 1000));
  return toBinary(ClientMessageSchema, create(ClientMessageSchema, { seq, clientTimeUs, body }));
}
