// Every setting of the schema on every way that the page takes it.

import { create, fromBinary, toBinary } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import { ClientMessageSchema } from '../../src/gen/froxel/v1/client_pb';
import { choicesFor } from '../../src/settings/fields';
import { settingCommands } from '../../src/settings/setting_commands';
import { kRows, putAt, valueAt, type Row } from '../../src/settings/setting_table';
import { settingsOf, valueOf, type Settings, type Value } from '../../src/settings/settings';
import { formatAddress, parseAddress } from '../../src/state/address';
import { kBounds, sampleSettings, viewState } from '../sample';

const base = sampleSettings();

function otherValue(row: Row): Value {
  if (row.kind === 'color') return { x: 0.25, y: 0.5, z: 0.75 };
  if (row.kind === 'boolean') return !valueOf(base, row);
  const value = valueOf(base, row);
  if (row.kind === 'number') return value + (row.integer ? 1 : 0.5);
  const other = choicesFor(row).find((choice) => choice.value !== value);
  if (!other) throw new Error(`${row.name} has one name alone`);
  return other.value;
}

describe('the table', () => {
  it('Rows_HaveEachKeyOnceAndNoneOfThePagesOwn', () => {
    const keys = kRows.map(({ key }) => key);
    expect(new Set(keys).size).toBe(keys.length);
    const own = ['eye', 'fovDeg', 'lightBox', 'gridX', 'toonFragment', 'width'];
    expect(keys.filter((key) => own.includes(key))).toEqual([]);
  });

  it('Rows_HaveTheSettingsThatCodeNames', () => {
    const named: Readonly<Record<string, readonly (keyof Settings)[]>> = {
      number: ['lights', 'lightRadius', 'animationSpeed', 'exposure', 'fogDensity', 'shadowLights', 'quality'],
      boolean: ['animate', 'animationPlaying', 'environmentBackground'],
      choice: ['renderer', 'animationRepeat', 'bloom', 'transparency', 'environment', 'codec', 'refine'],
    };
    for (const [kind, keys] of Object.entries(named)) {
      for (const key of keys) expect(kRows.find((row) => row.key === key)?.kind).toBe(kind);
    }
  });

  it('Row_SaysWhereItsFieldsStand', () => {
    expect(kRows.find(({ name }) => name === 'fog_tile')).toEqual({
      name: 'fog_tile',
      key: 'fogTile',
      kind: 'number',
      integer: true,
      command: 'setFog',
      inCommand: { groups: ['fog'], name: 'tile' },
      inState: { groups: ['fog'], name: 'tile' },
    });
    expect(kRows.find(({ name }) => name === 'target_fps')).toMatchObject({ softMin: 1 });
    expect(kRows.find(({ name }) => name === 'environment_rotation')).toMatchObject({ angle: true });
    expect(kRows.find(({ name }) => name === 'seed')).toMatchObject({
      key: 'seed',
      command: 'setLights',
      inCommand: { groups: [], name: 'seed' },
      inState: { groups: [], name: 'lightSeed' },
    });
  });
});

describe.each(kRows.map((row) => [row.name, row] as const))('setting %s', (_, row) => {
  const value = otherValue(row);
  const changed: Settings = { ...base, [row.key]: value };

  it('Change_IsOneCommandThatHoldsIt', () => {
    const [body, ...rest] = settingCommands(base, changed);
    if (!body) throw new Error('no command');
    expect(rest).toEqual([]);
    const bytes = toBinary(ClientMessageSchema, create(ClientMessageSchema, { body }));
    const message = fromBinary(ClientMessageSchema, bytes).body;
    expect(message.case).toBe(row.command);
    expect(valueAt({ ...message.value }, row.inCommand)).toEqual(
      typeof value === 'object' ? expect.objectContaining(value) : value,
    );
  });

  it('State_IsReadBack', () => {
    const state = viewState();
    putAt(state, row.inState, value);
    expect(settingsOf(state, kBounds, [])).toEqual(changed);
  });

  it('Address_BringsItAlong', () => {
    const address = parseAddress(formatAddress(changed, { kind: 'fixed' }, base));
    expect(address.problems).toEqual([]);
    expect({ ...base, ...address.settings }).toEqual(changed);
  });
});
