// What a scalar setting is to the panel and to the address.

import type { DescEnum } from '@bufbuild/protobuf';

export type Kind =
  | {
      readonly kind: 'number';
      readonly integer: boolean;
      readonly softMin?: number; // the least above 0 that is worth asking for; none: not known
      readonly angle?: boolean;
    }
  | { readonly kind: 'boolean' }
  | { readonly kind: 'choice'; readonly schema: DescEnum }
  | { readonly kind: 'color' };

interface Named {
  readonly name: string; // in the address, and of its control
  readonly key: string; // in Settings
}

export type NumberKind = Extract<Kind, { kind: 'number' }>;
export type Field = Named & Kind;
export type NumberField = Extract<Field, { kind: 'number' }>;
export type ChoiceField = Extract<Field, { kind: 'choice' }>;
export type ColorField = Extract<Field, { kind: 'color' }>;

/** What a setting's numbers may be, both ends included. */
export interface Range {
  readonly min: number;
  readonly max: number;
}

export const kMaxUint32 = 0xffff_ffff;

/** Whether a protobuf uint32 can carry it. */
export const isUint32 = (value: number): boolean =>
  Number.isInteger(value) && value >= 0 && value <= kMaxUint32;
