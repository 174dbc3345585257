// What a scalar setting is to the panel and to the URL.

import type { DescEnum } from '@bufbuild/protobuf';

export type Kind =
  | { readonly kind: 'number'; readonly integer: boolean }
  | { readonly kind: 'boolean' }
  | { readonly kind: 'choice'; readonly schema: DescEnum }
  | { readonly kind: 'color' };

interface Named {
  readonly name: string; // in links, and of its control
  readonly key: string; // in Settings
}

export type Field = Named & Kind;
export type NumberField = Extract<Field, { kind: 'number' }>;
export type ChoiceField = Extract<Field, { kind: 'choice' }>;
export type ColorField = Extract<Field, { kind: 'color' }>;
