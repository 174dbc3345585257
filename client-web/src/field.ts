// What a scalar setting is to the panel and to the URL.

import type { DescEnum } from '@bufbuild/protobuf';

import type { Settings } from './settings';

type KeysOf<T> = {
  [Key in keyof Settings]: Settings[Key] extends T ? Key : never;
}[keyof Settings];

type ChoiceKey =
  | 'renderer'
  | 'lighting'
  | 'shading'
  | 'gbufferNormal'
  | 'gbufferPosition'
  | 'gridLaw'
  | 'lightLoop'
  | 'toneMap'
  | 'bloom'
  | 'antialiasing'
  | 'transparency'
  | 'chroma'
  | 'codec'
  | 'refine'
  | 'debugView';

interface Base {
  readonly name: string;
  readonly label: string;
  readonly tip: string;
}

export interface NumberField extends Base {
  readonly kind: 'number';
  readonly key: KeysOf<number>;
  readonly integer: boolean;
  /** 'log' where useful values span decades, 'none' for a plain number box. */
  readonly slider: 'linear' | 'log' | 'none';
}

export interface BooleanField extends Base {
  readonly kind: 'boolean';
  readonly key: KeysOf<boolean>;
}

export interface ChoiceField extends Base {
  readonly kind: 'choice';
  readonly key: ChoiceKey;
  readonly schema: DescEnum;
}

export type Field = NumberField | BooleanField | ChoiceField;

export type Section =
  | 'camera'
  | 'rendering'
  | 'effects'
  | 'lights'
  | 'clusters'
  | 'debug'
  | 'stream';

export const number = (
  key: KeysOf<number>,
  name: string,
  label: string,
  slider: NumberField['slider'],
  integer: boolean,
  tip: string,
): NumberField => ({ kind: 'number', key, name, label, slider, integer, tip });

export const choice = (
  key: ChoiceField['key'],
  name: string,
  label: string,
  schema: DescEnum,
  tip: string,
): ChoiceField => ({ kind: 'choice', key, name, label, schema, tip });

export const toggle = (
  key: KeysOf<boolean>,
  name: string,
  label: string,
  tip: string,
): BooleanField => ({ kind: 'boolean', key, name, label, tip });
