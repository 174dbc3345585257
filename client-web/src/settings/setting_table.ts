// The table of settings, made of the schema alone: each field with the option (setting) holds one,
// once in a command and once in ViewState.

import { getOption, ScalarType, type DescField, type DescMessage } from '@bufbuild/protobuf';

import { ClientMessageSchema, type ClientMessage } from '../gen/froxel/v1/client_pb';
import { Vec3Schema, ViewStateSchema } from '../gen/froxel/v1/common_pb';
import { angle, setting, soft_min } from '../gen/froxel/v1/options_pb';
import type { Field, Kind } from './field';

export type CommandName = NonNullable<ClientMessage['body']['case']>;

/** Where a field stands below a message, by local names. */
export interface Place {
  readonly groups: readonly string[]; // messages on the way
  readonly name: string;
}

export type Row = Field & {
  readonly command: CommandName;
  readonly inCommand: Place;
  readonly inState: Place;
};

interface Found {
  readonly setting: string;
  readonly field: DescField;
  readonly place: Place;
}

function settingsBelow(message: DescMessage, groups: readonly string[] = []): Found[] {
  return message.fields.flatMap((field) => {
    const name = getOption(field, setting);
    if (name !== '') return [{ setting: name, field, place: { groups, name: field.localName } }];
    if (field.fieldKind !== 'message') return [];
    return settingsBelow(field.message, [...groups, field.localName]);
  });
}

function sliderOf(field: DescField): { softMin?: number; angle?: boolean } {
  const softMin = getOption(field, soft_min);
  return { ...(softMin > 0 && { softMin }), ...(getOption(field, angle) && { angle: true }) };
}

function kindOf(field: DescField): Kind {
  if (field.fieldKind === 'enum') return { kind: 'choice', schema: field.enum };
  if (field.fieldKind === 'message' && field.message.typeName === Vec3Schema.typeName) {
    return { kind: 'color' };
  }
  switch (field.fieldKind === 'scalar' ? field.scalar : undefined) {
    case ScalarType.BOOL:
      return { kind: 'boolean' };
    case ScalarType.UINT32:
      return { kind: 'number', integer: true };
    case ScalarType.DOUBLE:
      return { kind: 'number', integer: false, ...sliderOf(field) };
    default:
      throw new Error(`${field.toString()} is not of a kind that a setting can have`);
  }
}

const camelCase = (name: string): string =>
  name.replace(/_(\w)/g, (_, letter: string) => letter.toUpperCase());

function rowsOf(schema: DescMessage, command: CommandName): Row[] {
  const states = settingsBelow(ViewStateSchema);
  return settingsBelow(schema).map(({ setting: name, field, place }) => {
    const state = states.find((found) => found.setting === name);
    if (!state) throw new Error(`ViewState has no field of the setting ${name}`);
    const places = { command, inCommand: place, inState: state.place };
    return { name, key: camelCase(name), ...kindOf(field), ...places };
  });
}

/** In the schema's order. */
export const kRows: readonly Row[] = ClientMessageSchema.fields.flatMap((body) =>
  body.oneof && body.message ? rowsOf(body.message, body.localName as CommandName) : [],
);

/** A message, or what one is made of, as far as places are concerned. */
export type Parts = Record<string, unknown>;

/** What stands at a place of a message; nothing where a message on the way is absent. */
export function valueAt(message: Readonly<Parts>, { groups, name }: Place): unknown {
  const parts = groups.reduce<Readonly<Parts> | undefined>(
    (above, group) => above?.[group] as Readonly<Parts> | undefined,
    message,
  );
  return parts?.[name];
}

/** Puts a value there, into messages on the way that are made where they are absent. */
export function putAt(message: Parts, { groups, name }: Place, value: unknown): void {
  let parts = message;
  for (const group of groups) parts = (parts[group] ??= {}) as Parts;
  parts[name] = value;
}
