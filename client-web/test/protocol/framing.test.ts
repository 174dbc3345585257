import { fromBinary } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { ClientMessageSchema } from '../../src/gen/froxel/v1/client_pb';
import { decodeBinary, encodeCommand } from '../../src/protocol/framing';
import { serverMessage, serverMessageBytes } from '../fakes';

describe('framing', () => {
  it('ServerMessage_InBinary_IsDecoded', () => {
    const bytes = serverMessageBytes(serverMessage({ case: 'pong', value: { refSeq: 5n } }));
    const received = decodeBinary(bytes.buffer);
    expect(received).toMatchObject({
      kind: 'message',
      message: { body: { case: 'pong', value: { refSeq: 5n } } },
    });
  });

  it('ServerMessage_WithAHeaderLength_IsRefused', () => {
    expect(() => decodeBinary(new Uint8Array([0xf7, 2, 1, 0]).buffer)).toThrow(/header of 1 bytes/);
  });

  it('Refusal_NamesWhatIsWrong', () => {
    expect(() => decodeBinary(new Uint8Array([1, 1, 0, 0]).buffer)).toThrow(/byte 1, not 247/);
    expect(() => decodeBinary(new Uint8Array([0xf7]).buffer)).toThrow(/of 1 bytes/);
    expect(() => decodeBinary(new Uint8Array([0xf7, 2, 0, 0, 0xff]).buffer)).toThrow(/ServerMessage/);
  });

  it('Command_CarriesSequenceAndMonotonicMicroseconds', () => {
    const bytes = encodeCommand(3n, 12.3456, { case: 'ack', value: { frameId: 9n } });
    expect(fromBinary(ClientMessageSchema, bytes)).toMatchObject({
      seq: 3n,
      clientTimeUs: 12346n,
      body: { case: 'ack', value: { frameId: 9n } },
    });
  });
});
