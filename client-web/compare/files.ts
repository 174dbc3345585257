// Files to draw and where results go.

import { existsSync, mkdirSync, readdirSync, rmSync } from 'node:fs';
import { basename, extname, join, resolve } from 'node:path';

import { kRoot } from './programs';

/** As the person who called npm means it: npm itself runs scripts in its package's folder. */
export const given = (path: string): string => resolve(process.env.INIT_CWD ?? process.cwd(), path);

/** Every glTF file below a folder, in the order of their paths. */
export function scenesIn(folder: string): string[] {
  return readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((file) => ['.glb', '.gltf'].includes(extname(file).toLowerCase()))
    .sort()
    .map((file) => join(folder, file));
}

export const nameOf = (scene: string): string => basename(scene, extname(scene));

/** An empty folder of build/compare. */
export function freshFolder(name: string): string {
  const folder = join(kRoot, 'build/compare', name);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  return folder;
}

/** A panorama beside the checkout; null where it is not there. */
export function sharedPanorama(): string | null {
  const file = join(kRoot, '../shared/scenes/environments/warehouse.exr');
  if (existsSync(file)) return file;
  console.log(`skipped: ${file} is not there`);
  return null;
}

/** Scenes beside the checkout, where there are any. */
export function sharedScenes(): string[] {
  const folder = join(kRoot, '../shared/scenes/models');
  if (existsSync(folder)) return scenesIn(folder);
  console.log(`skipped: ${folder} is not there`);
  return [];
}
