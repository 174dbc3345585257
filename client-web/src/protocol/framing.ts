// How messages lie in WebSocket messages; protocol/README.md is the specification.
//
//   frame           0xF7 0x01 length(u16 LE)  FrameHeader[length]  encoded bytes…
//   server message  0xF7 0x02 0x0000          ServerMessage…
//   depth           0xF7 0x03 length(u16 LE)  DepthMeshHeader[length]  coded mesh…
//
// A client's binary message is a bare ClientMessage.

import { create, fromBinary, toBinary, type MessageInitShape } from '@bufbuild/protobuf';

import { ClientMessageSchema } from '../gen/froxel/v1/client_pb';
import {
  DepthMeshHeaderSchema,
  FrameHeaderSchema,
  ServerMessageSchema,
  type DepthMeshHeader,
  type FrameHeader,
  type ServerMessage,
} from '../gen/froxel/v1/server_pb';

export const kSubprotocol = 'froxel.v1';
export const kProtocolMajor = 1;
export const kProtocolMinor = 4;

const kMagic = 0xf7;
const kKindFrame = 1;
const kKindServerMessage = 2;
const kKindDepth = 3;
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

/** Depth of pictures that follow; warp/depth_mesh.ts reads the bytes, a view into the received message. */
export interface CodedDepth {
  readonly header: DepthMeshHeader;
  readonly bytes: Uint8Array;
}

export type Received =
  | { readonly kind: 'frame'; readonly frame: Frame }
  | { readonly kind: 'depth'; readonly depth: CodedDepth }
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
  if (kind === kKindDepth) {
    const { head, rest } = split(bytes, length, 'depth');
    const header = parse('DepthMeshHeader', () => fromBinary(DepthMeshHeaderSchema, head));
    return { kind: 'depth', depth: { header, bytes: rest } };
  }
  if (kind === kKindServerMessage && length === 0) {
    const body = bytes.subarray(kPrefixBytes);
    const message = parse('ServerMessage', () => fromBinary(ServerMessageSchema, body));
    return { kind: 'message', message };
  }
  throw new FramingError(`server message of kind ${kind} with a header of ${length} bytes`);
}

interface Split {
  readonly head: Uint8Array;
  readonly rest: Uint8Array<ArrayBuffer>;
}

function split(bytes: Uint8Array<ArrayBuffer>, length: number, name: string): Split {
  const behind = bytes.subarray(kPrefixBytes);
  if (length === 0 || length > kMaxHeaderBytes || length > behind.length) {
    throw new FramingError(`${name} header of ${length} bytes in ${behind.length}`);
  }
  return { head: behind.subarray(0, length), rest: behind.subarray(length) };
}

function decodeFrame(bytes: Uint8Array<ArrayBuffer>, length: number): Frame {
  const { head, rest: payload } = split(bytes, length, 'frame');
  const header = parse('FrameHeader', () => fromBinary(FrameHeaderSchema, head));
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
