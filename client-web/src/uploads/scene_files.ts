// Which of the files that a person brings are a scene's, and which it lacks.

import type { BroughtFile } from './dropped';

export interface SceneFiles {
  /** Paths from the scene's own folder; the scene's file comes first. */
  readonly files: readonly BroughtFile[];
  readonly missing: readonly string[]; // paths that the scene names
}

export const isScene = (path: string): boolean => /\.(glb|gltf|vrm|obj|ply|stl|3mf)$/i.test(path);

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
  const add = (path: string): Blob | undefined => {
    const file = byPath.get((folder + path).normalize());
    if (file && files.some((known) => known.path === path)) return file.blob;
    if (file) files.push({ path, blob: file.blob });
    else if (!missing.includes(path)) missing.push(path);
    return file?.blob;
  };
  for (const path of await namedBy(scene)) {
    const blob = add(path);
    if (blob && /\.mtl$/i.test(path)) imagesOf(await blob.text()).forEach(add);
  }
  return { files, missing };
}

/** The files that a scene's own file names, each once, as paths from its folder. */
async function namedBy({ path, blob }: BroughtFile): Promise<readonly string[]> {
  if (/\.obj$/i.test(path)) return matches(await blob.text(), /^[ \t]*mtllib[ \t]+(.+?)[ \t\r]*$/gm);
  if (/\.ply$/i.test(path)) {
    return matches(await blob.slice(0, kPlyHeader).text(), /^comment TextureFile (.+?)[ \t\r]*$/gm).slice(0, 1);
  }
  return /\.(stl|3mf)$/i.test(path) ? [] : namedByGltf(blob);
}

const kPlyHeader = 65536;

const matches = (text: string, pattern: RegExp): readonly string[] =>
  Array.from(text.matchAll(pattern), ([, name = '']) => pathOfName(name));

/** Of an MTL file: the images that the server reads, without the options before their names. */
const imagesOf = (text: string): readonly string[] =>
  matches(text, /^[ \t]*(?:map_Kd|map_d|map_Ke|map_Pr|map_Pm|norm)(?:[ \t]+-[a-z]+(?:[ \t]+(?:[-+.\d]+|on|off))*)*[ \t]+(.+?)[ \t\r]*$/gm);

/** With slashes; of another machine's absolute path the name alone. */
function pathOfName(name: string): string {
  const path = name.replace(/\\/g, '/');
  return /^(\/|[a-z]:)/i.test(path) ? path.slice(path.lastIndexOf('/') + 1) : withoutDots(path);
}

/** Of a glTF or GLB file. What is none names none. */
async function namedByGltf(blob: Blob): Promise<readonly string[]> {
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
  return withoutDots(text);
}

const withoutDots = (path: string): string =>
  path
    .split('/')
    .filter((part) => part !== '.' && part !== '')
    .join('/');

const kGlbHeader = 20; // and of the first chunk, which is the JSON: glTF 2.0, 4.4.2

async function jsonOf(blob: Blob): Promise<string> {
  const header = new DataView(await blob.slice(0, kGlbHeader).arrayBuffer());
  const isGlb = header.byteLength === kGlbHeader && header.getUint32(0, true) === 0x46546c67;
  return isGlb ? blob.slice(kGlbHeader, kGlbHeader + header.getUint32(12, true)).text() : blob.text();
}
