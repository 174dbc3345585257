// Cameras are where the server has them: protocol/vectors/paths.json is written by server/path.

import { readFileSync } from 'node:fs';

import { describe, expect, it } from 'vitest';

import { length, sub, vec, type Vec } from '../../src/core/vec3';
import { flythrough, turntable } from '../../src/path/built_in';
import { CameraPath, problemOf, type PathKeys, type View } from '../../src/path/camera_path';
import { parsePath } from '../../src/path/path_file';

type List = [number, number, number];
interface ViewJson {
  readonly eye: List;
  readonly target: List;
  readonly up: List;
  readonly fov_deg: number;
}
interface Vector {
  readonly name: string;
  readonly path?: unknown;
  readonly built_in?: string;
  readonly seconds: number;
  readonly first: unknown;
  readonly cameras?: unknown[];
  readonly box?: [List, List];
  readonly times: number[];
  readonly views: ViewJson[];
}

const kTolerance = 1e-9;
const vectors = JSON.parse(
  readFileSync(new URL('../../../protocol/vectors/paths.json', import.meta.url), 'utf8'),
) as Vector[];

function viewOf(json: unknown): View {
  const [key] = parsePath(JSON.stringify({ keys: [json] })).keys;
  if (!key) throw new Error('no key');
  return key;
}

function keysOf({ path, built_in: builtIn, seconds, first, cameras, box }: Vector): PathKeys {
  if (path !== undefined) return parsePath(JSON.stringify(path));
  if (builtIn === 'turntable') return turntable(viewOf(first), seconds);
  const bounds = box ? { min: vec(...box[0]), max: vec(...box[1]) } : null;
  return flythrough((cameras ?? []).map(viewOf), bounds, viewOf(first), seconds);
}

const apart = (a: Vec, b: List): number => length(sub(a, vec(...b))) / Math.max(1, length(a));

describe('paths.json', () => {
  it.each(vectors)('Views_$name_AreTheServers', (vector) => {
    const keys = keysOf(vector);
    expect(problemOf(keys)).toBe('');
    const path = new CameraPath(keys);
    expect(vector.views).toHaveLength(vector.times.length);
    for (const [i, time] of vector.times.entries()) {
      const [view, wanted] = [path.at(time), vector.views[i]];
      if (!wanted) throw new Error('no view');
      expect(apart(view.eye, wanted.eye), `eye at ${time}`).toBeLessThan(kTolerance);
      expect(apart(view.target, wanted.target), `target at ${time}`).toBeLessThan(kTolerance);
      // Keys keep their own up, which need not be perpendicular; both mean the same.
      const upright = (up: Vec): Vec => {
        const ahead = sub(view.target, view.eye);
        const along = (up.x * ahead.x + up.y * ahead.y + up.z * ahead.z) / length(ahead) ** 2;
        const across = sub(up, vec(along * ahead.x, along * ahead.y, along * ahead.z));
        const norm = length(across);
        return vec(across.x / norm, across.y / norm, across.z / norm);
      };
      expect(apart(upright(view.up), wanted.up), `up at ${time}`).toBeLessThan(1e-6);
      expect(view.fovDeg).toBeCloseTo(wanted.fov_deg, 9);
    }
  });
});
