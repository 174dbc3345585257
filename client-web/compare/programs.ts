// Programs of the build: froxel, and those of tests/compare.

import { execFile } from 'node:child_process';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

import { vec, type Vec } from '../src/core/vec3';
import { sphereOf, type Sphere } from './view';

export const kRoot = fileURLToPath(new URL('../..', import.meta.url));

export const kBuild = process.env.FROXEL_BUILD ?? join(kRoot, 'build/test');
const kFroxel = join(kBuild, 'froxel');
const kTools = join(kBuild, 'tests/compare');
const kMostOutput = 64 * 1024 * 1024; // bytes: a scene may have many warnings

/** Gives stdout. Rejects with what the program said last. */
async function run(program: string, args: readonly string[]): Promise<string> {
  try {
    return (await promisify(execFile)(program, args, { maxBuffer: kMostOutput })).stdout;
  } catch (error) {
    const { stderr = '', message } = error as { stderr?: string; message: string };
    throw new Error(stderr.trim().split('\n').at(-1) ?? message, { cause: error });
  }
}

export const render = (scene: string, out: string, options: readonly string[]): Promise<string> =>
  run(kFroxel, ['render', '--scene', scene, '--look', 'none', '--out', out, ...options]);

type Triple = readonly [number, number, number];

interface Info {
  readonly scene: {
    readonly bounds_m: { readonly min: Triple; readonly max: Triple } | null;
    readonly warnings: readonly { readonly code: string; readonly severity: number; readonly message: string }[];
    readonly warnings_left_out: number;
  };
}

export interface SceneFacts {
  readonly sphere: Sphere;
  readonly warnings: readonly string[];
}

export async function sceneFacts(scene: string): Promise<SceneFacts> {
  const info = JSON.parse(await run(kFroxel, ['info', '--scene', scene, '--json'])) as Info;
  const { bounds_m: bounds, warnings, warnings_left_out: leftOut } = info.scene;
  if (!bounds) throw new Error('nothing to draw');
  const corner = (triple: Triple): Vec => vec(...triple);
  return {
    sphere: sphereOf(corner(bounds.min), corner(bounds.max)),
    warnings: [
      ...warnings.map(({ code, severity, message }) => `${severity === 1 ? '' : 'remark: '}${code}: ${message}`),
      ...(leftOut > 0 ? [`and ${leftOut} more`] : []),
    ],
  };
}

const numbers = async (...args: string[]): Promise<unknown> =>
  JSON.parse(await run(join(kTools, 'picture_numbers'), args));

export interface Difference {
  readonly flip: number; // mean LDR-FLIP
  readonly mssim: number;
  readonly drawn: number; // the share of pixels that are not background
}

export const difference = (picture: string, reference: string): Promise<Difference> =>
  numbers('difference', picture, reference) as Promise<Difference>;

/** Shares: of the picture; of its surfaces. Null where there is none. */
export interface Clipped {
  readonly surface: number;
  readonly black: number | null; // all channels at 0
  readonly blown: number | null; // a channel at 255
}

/** depthView: of the same frame, which says where a solid surface is. */
export const clipped = (picture: string, depthView: string): Promise<Clipped> =>
  numbers('clipped', picture, depthView) as Promise<Clipped>;

/** A small GLB file for each feature of materials and lights. */
export const writeFeatures = (folder: string): Promise<string> => run(join(kTools, 'feature_scenes'), [folder]);
