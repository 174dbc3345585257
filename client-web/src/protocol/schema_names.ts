// The protocol's enum values under the names that people read: "clustered_deferred", "420".

import type { DescEnum } from '@bufbuild/protobuf';

export interface Choice {
  readonly name: string;
  readonly value: number;
}

/** All values of a protocol enum but the unspecified one, without their common prefix. */
export function choicesOf(schema: DescEnum): Choice[] {
  // By the style guide's rule, since a prefix before digits ("CHROMA_420") is not found for us.
  const unspecified = schema.values.find((value) => value.number === 0)?.name ?? '';
  const prefix = unspecified.replace(/UNSPECIFIED$/, '');
  return schema.values
    .filter((value) => value.number !== 0)
    .map((value) => ({
      name: value.name.toLowerCase().slice(prefix.length),
      value: value.number,
    }));
}

/** The name of a value in words; "none" of one that the schema does not have. */
export const nameIn = (schema: DescEnum, wanted: number): string =>
  choicesOf(schema).find(({ value }) => value === wanted)?.name.replaceAll('_', ' ') ?? 'none';
