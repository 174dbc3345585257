// The fields of the panel and of the address: the schema's settings, and the few scalars that stand
// beside them. Under `name` Welcome.ranges tells what the server accepts.

import { BloomKind, EnvironmentLight, Transparency } from '../gen/froxel/v1/common_pb';
import { rowOf } from '../picture/codecs';
import { choicesOf, type Choice } from '../protocol/schema_names';
import type { ChoiceField, Field, Kind } from './field';
import { kRows, type CommandName, type Row } from './setting_table';
import { isDeferred, isToon, type Settings, type Value } from './settings';

export type Section =
  | 'camera'
  | 'rendering'
  | 'exposure'
  | 'effects'
  | 'lights'
  | 'animation'
  | 'materials'
  | 'environment'
  | 'clusters'
  | 'debug'
  | 'stream';

/** Where the panel has the settings of a command; effects are what is not named. */
const kSections: Readonly<Partial<Record<CommandName, Section>>> = {
  setRenderer: 'rendering',
  setGeometry: 'rendering',
  setExposure: 'exposure',
  setLights: 'lights',
  setAnimation: 'animation',
  setEnvironment: 'environment',
  setGrid: 'clusters',
  setDebugView: 'debug',
  setEncoding: 'stream',
  setDelivery: 'stream',
};
const kOfClusters: readonly string[] = ['light_loop', 'list_cap', 'count_pairs'];

const sectionOf = ({ name, command }: Row): Section =>
  kOfClusters.includes(name) ? 'clusters' : (kSections[command] ?? 'effects');

const kNumber: Kind = { kind: 'number', integer: false };
const kWhole: Kind = { kind: 'number', integer: true };
const kSwitch: Kind = { kind: 'boolean' };

const byHand = (name: string, key: keyof Settings, kind: Kind): Field => ({ name, key, ...kind });

const kByHand: Readonly<Partial<Record<Section, readonly Field[]>>> = {
  camera: [
    byHand('fov_deg', 'fovDeg', kNumber),
    byHand('lens_shift.x', 'lensShiftX', kNumber),
    byHand('lens_shift.y', 'lensShiftY', kNumber),
  ],
  clusters: [
    byHand('grid.auto', 'gridAutomatic', kSwitch),
    byHand('grid.x', 'gridX', kWhole),
    byHand('grid.y', 'gridY', kWhole),
    byHand('grid.z', 'gridZ', kWhole),
  ],
  animation: [byHand('animation', 'animation', kWhole)],
  materials: [byHand('material_variant', 'materialVariant', kWhole)],
  debug: [byHand('debug_frozen', 'debugFrozen', kSwitch)],
};

export const fieldsOf = (section: Section): readonly Field[] => [
  ...kRows.filter((row) => sectionOf(row) === section),
  ...(kByHand[section] ?? []),
];

export const kAllFields: readonly Field[] = [...kRows, ...Object.values(kByHand).flat()];

/** The values that a viewer may choose. */
export const choicesFor = ({ name, schema }: ChoiceField): Choice[] =>
  choicesOf(schema).filter(({ value }) => name !== 'codec' || rowOf(value)?.chosen);

/** Whether a field is one of the grid's sides, which count only while it is not automatic. */
export const isGridSide = ({ name }: Field): boolean => /^grid\.[xyz]$/.test(name);

/** When fields change something, by how their names begin; the first that fits says it. */
const kUses: readonly (readonly [string, (settings: Settings) => boolean])[] = [
  ['gbuffer_', isDeferred],
  ['outline_', isToon],
  ['toon_', isToon],
  ['fog_density', () => true],
  ['fog_', ({ fogDensity }) => fogDensity > 0],
  [
    'environment_blur',
    ({ environment, environmentBackground }) =>
      environmentBackground && environment !== EnvironmentLight.OFF,
  ],
  ['environment_', ({ environment }) => environment !== EnvironmentLight.OFF],
  ['shadow_size', ({ shadowLights }) => shadowLights > 0],
  ['bloom_', ({ bloom }) => bloom !== BloomKind.NONE],
  ['peel_layers', ({ transparency }) => transparency === Transparency.PEELED],
];

/** Whether a field changes anything as the other settings are. */
export function isInUse(field: Field, settings: Settings): boolean {
  if (isGridSide(field)) return !settings.gridAutomatic;
  const use = kUses.find(([prefix]) => field.name.startsWith(prefix));
  return use ? use[1](settings) : true;
}

/**
 * The edit that sets a field; an angle of view makes the projection perspective, and a side of the
 * grid makes it one by hand.
 */
export function patchFor(field: Field, value: Value): Partial<Settings> {
  return {
    [field.key]: value,
    ...(field.key === 'fovDeg' && { orthographic: false }),
    ...(isGridSide(field) && { gridAutomatic: false }),
  };
}
