import { describe, expect, it } from 'vitest';

import { jsonOf, parsePath, pathLine, pathText } from '../../src/path/path_file';

const kTwo = `{"seconds": 8, "keys": [
  {"at_s": 1, "eye": [0, 1, 2], "target": [0, 1, 0]},
  {"at_s": 3, "eye": [4, 1, 2], "target": [0, 1, 0], "up": [0, 0, 1], "fov_deg": 60}]}`;

const faultOf = (text: string): string => {
  try {
    parsePath(text);
    return 'read';
  } catch (error) {
    return error instanceof Error ? error.message : '';
  }
};
const keys = (list: string): string => `{"keys": [${list}]}`;

describe('path file', () => {
  it('Keys_AreReadAndWritten', () => {
    const path = parsePath(kTwo);
    expect(path).toMatchObject({ seconds: 8, loop: false, constantSpeed: false });
    expect(path.keys[1]).toMatchObject({ atS: 3, fovDeg: 60, up: { x: 0, y: 0, z: 1 } });
    expect(parsePath(pathText(path))).toEqual(path);
    expect(parsePath(pathLine(path))).toEqual(path);
    expect(pathLine({ ...path, loop: true, constantSpeed: true })).toContain('"constant_speed":true,"loop":true');
  });

  it('WhatIsAsUsual_IsLeftOut', () => {
    const [first] = jsonOf(parsePath(kTwo)).keys as Record<string, unknown>[];
    expect(Object.keys(first ?? {})).toEqual(['at_s', 'eye', 'target', 'fov_deg']);
  });

  it('WithoutTimes_KeysAreEvenlySpaced', () => {
    const list = [1, 2, 3].map((z) => `{"eye": [0, 0, ${z}], "target": [0, 0, 0]}`).join(',');
    const open = parsePath(`{"seconds": 6, "keys": [${list}]}`);
    expect(open.keys.map(({ atS }) => atS)).toEqual([0, 3, 6]);
    const loop = parsePath(`{"seconds": 6, "loop": true, "keys": [${list}]}`);
    expect(loop.keys.map(({ atS }) => atS)).toEqual([0, 2, 4]);
  });

  it.each([
    ['not JSON', 'expected a JSON object with a list of keys'],
    ['[]', 'expected a JSON object with a list of keys'],
    ['{"keys": 5}', 'expected a JSON object with a list of keys'],
    ['{"keys": []}', 'keys has 0; it must have 1 to 1000'],
    ['{"keys": [], "speed": 1}', 'speed is not a member of a camera path'],
    ['{"keys": [], "loop": 1}', 'loop is 1; it must be true or false'],
    ['{"keys": [], "seconds": 4000}', 'seconds is 4000; it must be a number from 0 to 3600'],
    [keys('3'), 'keys[0] is 3; it must be an object'],
    [keys('{"eye": [0, 0, 0]}'), 'keys[0].target is missing'],
    [keys('{"eye": [0, 0, 0], "target": [0, 0, 0]}'), 'keys[0].target is 0 m from the eye; it must be 0.000001 to 100000000'],
    [keys('{"eye": [0, 0, 1e9], "target": [0, 0, 0]}'), 'keys[0].eye[2] is 1000000000; it must be a number from -10000000 to 10000000'],
    [keys('{"eye": [0, 0], "target": [0, 0, 0]}'), 'keys[0].eye is [0,0]; it must be three numbers'],
    [keys('{"eye": [0, 0, 1], "target": [0, 0, 0], "up": [0, 0, 0]}'), 'keys[0].up is 0 m long; it must be 0.000001 to 100000000'],
    [keys('{"eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 0}'), 'keys[0].fov_deg is 0; it must be a number from 1 to 170'],
    [
      keys('{"eye": [0, 0, 1], "target": [0, 0, 0], "at_s": 1}, {"eye": [0, 0, 1], "target": [0, 0, 0]}'),
      'keys: 1 of 2 have at_s; expected all or none',
    ],
    [
      keys('{"eye": [0, 0, 1], "target": [0, 0, 0], "at_s": 1}, {"eye": [0, 0, 1], "target": [0, 0, 0], "at_s": 1}'),
      'keys[1].at_s is 1; it must be more than 1, that of the key before it',
    ],
    [
      `{"constant_speed": true, "seconds": 2, "keys": [{"eye": [0, 0, 1], "target": [0, 0, 0]}, {"eye": [0, 0, 1], "target": [0, 1, 0]}]}`,
      'keys[1].eye is that of the key before it; with constant_speed each key must be somewhere else',
    ],
  ])('Fault_%s_IsNamed', (text, message) => {
    expect(faultOf(text)).toContain(message);
  });
});
