// The page's table of codecs against the schema.

import { afterEach, describe, expect, it, vi } from 'vitest';

import { decodableCodecs, kCodecs, kPlainCodec, rowOf } from '../../src/picture/codecs';
import { Codec, CodecSchema } from '../../src/gen/froxel/v1/common_pb';
import { choicesOf } from '../../src/protocol/schema_names';

afterEach(() => vi.unstubAllGlobals());

describe('the table of codecs', () => {
  it('EveryValueOfTheSchema_HasOneRow', () => {
    const values = kCodecs.map(({ codec }): number => codec).sort((a, b) => a - b);
    expect(values).toEqual(choicesOf(CodecSchema).map(({ value }) => value));
    expect(rowOf(Codec.UNSPECIFIED)).toBeUndefined();
  });

  it('PlainCodec_NeedsNoneOfTheBrowser', async () => {
    expect(rowOf(kPlainCodec)).toMatchObject({ chosen: true, framesDepend: false });
    expect(await decodableCodecs()).toEqual([kPlainCodec]); // here is no WebCodecs
  });

  it('Video_IsOfferedWhereAllOfItIsDecoded', async () => {
    const asked: string[] = [];
    let supported = true;
    const isConfigSupported = ({ codec }: VideoDecoderConfig) => {
      asked.push(codec);
      return Promise.resolve({ supported });
    };
    vi.stubGlobal('VideoDecoder', { isConfigSupported });
    expect(await decodableCodecs()).toEqual([Codec.JPEG, Codec.VP9]);
    expect(asked).toEqual(['vp09.00.62.08', 'vp09.01.62.08']);
    supported = false;
    expect(await decodableCodecs()).toEqual([Codec.JPEG]);
  });

  it('Stills_AreGivenToTheBrowserByTheirType', async () => {
    vi.stubGlobal('createImageBitmap', (blob: Blob) => Promise.resolve(blob));
    const part = { key: true, width: 1, height: 1, bytes: new Uint8Array([1]) };
    const typeOf = async (codec: Codec) => {
      const image = await rowOf(codec)?.makeDecoder().decode(part);
      return (image as unknown as Blob).type;
    };
    expect(await typeOf(Codec.JPEG)).toBe('image/jpeg');
    expect(await typeOf(Codec.PNG)).toBe('image/png');
  });
});
