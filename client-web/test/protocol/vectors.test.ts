// The golden vectors that the C++ tests read too: both sides must agree on every byte.

import { readFileSync } from 'node:fs';

import {
  createRegistry,
  fromBinary,
  fromJson,
  toBinary,
  toJson,
  type JsonValue,
} from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { file_froxel_v1_client } from '../../src/gen/froxel/v1/client_pb';
import { file_froxel_v1_common } from '../../src/gen/froxel/v1/common_pb';
import { FrameHeaderSchema, file_froxel_v1_server } from '../../src/gen/froxel/v1/server_pb';
import { decodeBinary, FramingError } from '../../src/protocol/framing';

interface MessageVector {
  readonly name: string;
  readonly type: string;
  readonly hex: string;
  readonly json: JsonValue;
}

interface FrameVector {
  readonly name: string;
  readonly hex: string;
  readonly error?: boolean;
  readonly header?: JsonValue;
  readonly payload?: string;
}

const registry = createRegistry(
  file_froxel_v1_client,
  file_froxel_v1_common,
  file_froxel_v1_server,
);
const read = (name: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../protocol/vectors/${name}`, import.meta.url), 'utf8'));
const hexOf = (bytes: Uint8Array): string => Buffer.from(bytes).toString('hex');
const bytesOf = (hex: string): Uint8Array<ArrayBuffer> =>
  new Uint8Array(hex.match(/../g)?.map((pair) => parseInt(pair, 16)) ?? []);

describe('vectors.json', () => {
  const vectors = read('vectors.json') as MessageVector[];

  it('HasVectors_OfEveryMessageType', () => {
    const types = new Set(vectors.map((vector) => vector.type));
    expect(types).toContain('froxel.v1.ClientMessage');
    expect(types).toContain('froxel.v1.ServerMessage');
    expect(types).toContain('froxel.v1.FrameHeader');
  });

  it.each(vectors)('Message_$name_IsTheSameAsBytesAndAsJson', ({ type, hex, json }) => {
    const schema = registry.getMessage(type);
    if (!schema) throw new Error(`no message ${type} in the schema`);
    const fromBytes = fromBinary(schema, bytesOf(hex));
    expect(toJson(schema, fromBytes)).toEqual(json);
    expect(hexOf(toBinary(schema, fromJson(schema, json)))).toBe(hex);
  });
});

describe('frames.json', () => {
  const vectors = read('frames.json') as FrameVector[];
  const good = vectors.filter((vector) => vector.error !== true);
  const bad = vectors.filter((vector) => vector.error === true && !vector.hex.startsWith('f702'));

  it('HasBothGoodAndBadFrames', () => {
    expect(good.length).toBeGreaterThan(0);
    expect(bad.length).toBeGreaterThan(0);
  });

  it.each(good)('Frame_$name_Decodes', ({ hex, header, payload }) => {
    const received = decodeBinary(bytesOf(hex).buffer);
    if (received.kind !== 'frame') throw new Error('not a frame');
    expect(toJson(FrameHeaderSchema, received.frame.header)).toEqual(header);
    expect(hexOf(received.frame.payload)).toBe(payload);
  });

  it.each(bad)('Frame_$name_IsRefused', ({ hex }) => {
    expect(() => decodeBinary(bytesOf(hex).buffer)).toThrow(FramingError);
  });
});
