// Which of the files that a person brings are a scene's, and which it lacks.

import type { BroughtFile } from './dropped';

export interface SceneFiles {
  /** Paths from the scene's own folder; the scene's file comes first. */
  readonly files: readonly BroughtFile[];
  readonly missing: readonly string[]; // paths that the scene names
}

export const isScene = (path: string): boolean => /\.(glb|gltf|vrm)$/i.test(path);

export const scenesIn = (files: readonly BroughtFile[]): readonly BroughtFile[] =>
  files.filter(({ path }) => isScene(path));

interface Named {
  readonly uri?: unknown;
}

/** With what the scene names alone: whatever else lies beside it stays here. */
export async function sceneFiles(scene: BroughtFile, all: readonly BroughtFile[]): Promise<SceneFiles> {
  const folder = scene.path.slice(0, scene.path.lastIndexOf('/') + 1);
  const byPath = new Map(all.map((file) => [file.path.normalize(), file]));
  const files: BroughtFile[] = [{ path: scene.path.slice(folder.length), blob: scene.blob }];
  const missing: string[] = [];
  for (const path of await namedBy(scene.blob)) {
    const file = byPath.get((folder + path).normalize());
    if (file) files.push({ path, blob: file.blob });
    else missing.push(path);
  }
  return { files, missing };
}

/** The files that a glTF or GLB file names, each once, as paths from its folder. What is no scene names none. */
async function namedBy(blob: Blob): Promise<readonly string[]> {
  let json: { readonly buffers?: unknown; readonly images?: unknown } | null;
  try {
    json = JSON.parse(await jsonOf(blob)) as typeof json;
  } catch {
    return []; // the server says what is wrong with it
  }
  const paths = new Set<string>();
  for (const list of [json?.buffers, json?.images]) {
    if (!Array.isArray(list)) continue;
    for (const named of list as readonly (Named | null)[]) {
      const uri = named?.uri;
      if (typeof uri === 'string' && !/^(data|https?):/i.test(uri)) paths.add(pathOf(uri));
    }
  }
  return [...paths];
}

/** A URI's path without ".", as the server has it. */
function pathOf(uri: string): string {
  let text = uri;
  try {
    text = decodeURIComponent(uri);
  } catch {
    // A % that stands for itself.
  }
  return text
    .split('/')
    .filter((part) => part !== '.' && part !== '')
    .join('/');
}

const kGlbHeader = 20; // and of the first chunk, which is the JSON: glTF 2.0, 4.4.2

async function jsonOf(blob: Blob): Promise<string> {
  const header = new DataView(await blob.slice(0, kGlbHeader).arrayBuffer());
  const isGlb = header.byteLength === kGlbHeader && header.getUint32(0, true) === 0x46546c67;
  return isGlb ? blob.slice(kGlbHeader, kGlbHeader + header.getUint32(12, true)).text() : blob.text();
}
