import { create } from '@bufbuild/protobuf';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';

import { LookSchema } from '../../src/gen/froxel/v1/server_pb';
import { parseAddress } from '../../src/state/address';
import type { ServerInfo } from '../../src/state/app_state';
import { dropLook, isLook, keepLook, lookAddress, offeredLooks, ownLooks } from '../../src/state/looks';
import { sampleSettings } from '../sample';

let held = new Map<string, string>();
beforeEach(() => {
  held = new Map();
  vi.stubGlobal('localStorage', {
    getItem: (key: string) => held.get(key) ?? null,
    setItem: (key: string, value: string) => void held.set(key, value),
  });
});
afterEach(() => vi.unstubAllGlobals());

const server = (address: string): ServerInfo => ({
  version: '', protocolMinor: 1, offersDepth: false, device: '', scene: null, bounds: null, ranges: new Map(),
  initial: sampleSettings(),
  looks: [create(LookSchema, { name: 'evening', label: 'Evening', help: 'Warm', address })],
});

test('Looks_OfTheServer_AreOffered', () => {
  expect(offeredLooks(server('lights=3'))).toEqual([
    { name: 'evening', label: 'Evening', help: 'Warm', address: 'lights=3', own: false },
  ]);
  expect(offeredLooks(null)).toEqual([]);
});

test('LookAddress_HasWhatLooksSet_AsItIsNow', () => {
  const address = lookAddress(server('lights=3&bloom=none'), sampleSettings({ lights: 7 }));
  expect(address.split('&').sort()).toEqual(['bloom=none', 'lights=7']);
  expect(parseAddress(address).settings.lights).toBe(7);
  expect(lookAddress({ ...server(''), looks: [] }, sampleSettings())).toBe('');
});

test('IsLook_WhereAllThatItSetsIsSo_AsFloats', () => {
  const [look] = offeredLooks(server('exposure=0.1&fog_albedo=1,0.1,0'));
  const at = { exposure: Math.fround(0.1), fogAlbedo: { x: 1, y: Math.fround(0.1), z: 0 } };
  expect(look && isLook(look, sampleSettings({ ...at, lights: 7 }))).toBe(true);
  expect(look && isLook(look, sampleSettings({ ...at, exposure: 0.2 }))).toBe(false);
  expect(look && isLook(look, sampleSettings({ ...at, fogAlbedo: { x: 1, y: 0, z: 0 } }))).toBe(false);
});

test('OwnLooks_AreKept_ReplacedByName_AndDropped', () => {
  expect(keepLook(' Mine ', 'lights=3')).toBeNull();
  expect(keepLook('Other', 'lights=4')).toBeNull();
  expect(keepLook('Mine', 'lights=5')).toBeNull();
  expect(ownLooks().map(({ label, address }) => `${label} ${address}`)).toEqual(['Other lights=4', 'Mine lights=5']);
  expect(dropLook('Other')).toBeNull();
  expect(ownLooks().map(({ label }) => label)).toEqual(['Mine']);
});

test('OwnLooks_NamesAndNumbers_AreLimited', () => {
  expect(keepLook('  ', 'lights=3')).toContain('1 to 40');
  expect(keepLook('x'.repeat(41), 'lights=3')).toContain('1 to 40');
  for (let i = 0; i < 50; i += 1) expect(keepLook(`look ${i}`, '')).toBeNull();
  expect(keepLook('one more', '')).toContain('50 looks');
  expect(keepLook('look 7', 'lights=1')).toBeNull(); // in its own place
});

test.each(['{', '7', 'null', '{"a":1}', '[1,null,{"label":7},{"label":"","address":""}]'])(
  'OwnLooks_Holding_%s_AreNone',
  (text) => {
    held.set('froxel.looks', text);
    expect(ownLooks()).toEqual([]);
  },
);

test('OwnLooks_WhereNothingMayBeKept_SaySo', () => {
  const refuse = (): never => {
    throw new Error('forbidden');
  };
  vi.stubGlobal('localStorage', { getItem: refuse, setItem: refuse });
  expect(ownLooks()).toEqual([]);
  expect(keepLook('Mine', 'lights=3')).toContain('stores nothing');
});
