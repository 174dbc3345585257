// How pictures come encoded: a row a codec, with all that the page asks of it.

import { Codec } from '../gen/froxel/v1/common_pb';
import { stillDecoder, videoDecoder, type PartDecoder } from './part_decoder';
import { decodesVp9, vp9NameOf } from './vp9';

export interface CodecRow {
  readonly codec: Codec;
  /** By viewers; else by the server alone, for a picture that rests. */
  readonly chosen: boolean;
  /** On those before them, back to a key frame: video. */
  readonly framesDepend: boolean;
  /** Whether this browser decodes it. */
  readonly probe: () => Promise<boolean>;
  /** In the decode worker, once. */
  readonly makeDecoder: () => PartDecoder;
}

/** A picture that every browser decodes. */
const still = (codec: Codec, type: string, chosen: boolean): CodecRow => ({
  codec,
  chosen,
  framesDepend: false,
  probe: () => Promise.resolve(true),
  makeDecoder: () => stillDecoder(type),
});

export const kCodecs: readonly CodecRow[] = [
  still(Codec.JPEG, 'image/jpeg', true),
  still(Codec.PNG, 'image/png', false),
  {
    codec: Codec.VP9,
    chosen: true,
    framesDepend: true,
    probe: decodesVp9,
    makeDecoder: () => videoDecoder(vp9NameOf),
  },
];

/** What every session begins with. */
export const kPlainCodec = Codec.JPEG;

export const rowOf = (codec: Codec): CodecRow | undefined =>
  kCodecs.find((row) => row.codec === codec);

/** Those that viewers choose and this browser decodes. */
export async function decodableCodecs(): Promise<Codec[]> {
  const rows = kCodecs.filter(({ chosen }) => chosen);
  const decodes = await Promise.all(rows.map(({ probe }) => probe()));
  return rows.filter((_, index) => decodes[index]).map(({ codec }) => codec);
}
