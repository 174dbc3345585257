import { zipSync, type Zippable } from 'fflate';
import { describe, expect, it } from 'vitest';

import { chosenFiles, droppedFiles } from '../../src/uploads/dropped';

/** As a browser gives it. */
function entry(path: string, inside: readonly FileSystemEntry[] | null = null): FileSystemEntry {
  const name = path.slice(path.lastIndexOf('/') + 1);
  const waiting = inside === null ? [] : [...inside];
  return {
    fullPath: `/${path}`,
    name,
    isFile: inside === null,
    isDirectory: inside !== null,
    file: (done: (file: File) => void) => done(new File([path], name)),
    createReader: () => ({ readEntries: (done: (some: FileSystemEntry[]) => void) => done(waiting.splice(0, 100)) }),
  } as unknown as FileSystemEntry;
}

const list = (...files: File[]): FileList => files as unknown as FileList;
const zip = (held: Zippable): File => new File([new Uint8Array(zipSync(held))], 'scene.zip');
const paths = (files: readonly { path: string }[]): string[] => files.map(({ path }) => path).sort();

describe('dropped', () => {
  it('Folder_IsReadToItsEnd', async () => {
    const many = Array.from({ length: 250 }, (_, i) => entry(`fox/${i}.bin`));
    const files = await droppedFiles({ entries: [entry('fox', [...many, entry('fox/t', [entry('fox/t/a.png')])])], files: [] });
    expect(files.length).toBe(251);
    expect(paths(files)).toContain('fox/t/a.png');
  });

  it('HiddenFiles_StayHere', async () => {
    const files = await droppedFiles({
      entries: [entry('a.glb'), entry('.DS_Store'), entry('.git', [entry('.git/config')]), entry('__MACOSX', [entry('__MACOSX/a.glb')])],
      files: [new File(['x'], 'b.bin')],
    });
    expect(paths(files)).toEqual(['a.glb', 'b.bin']);
  });

  it('FolderWithoutEnd_IsRefused', async () => {
    const many = Array.from({ length: 100_001 }, (_, i) => entry(`${i}`));
    await expect(droppedFiles({ entries: many, files: [] })).rejects.toThrow('more than 100000 files');
  });
});

describe('chosen', () => {
  it('Zip_IsWhatItHolds', async () => {
    const bytes = new TextEncoder().encode('content');
    const files = await chosenFiles(list(zip({ 'a/b.gltf': bytes, 'a/': new Uint8Array(), '__MACOSX/x': bytes, 'a/.hidden': bytes })));
    expect(paths(files)).toEqual(['a/b.gltf']);
    expect(await files[0]?.blob.text()).toBe('content');
  });

  it('ZipBesideOthers_IsAFileLikeThem', async () => {
    expect(paths(await chosenFiles(list(zip({}), new File(['x'], 'a.glb'))))).toEqual(['a.glb', 'scene.zip']);
  });

  it('WhatIsNoZip_IsNamed', async () => {
    await expect(chosenFiles(list(new File(['no zip'], 'a.zip')))).rejects.toThrow('a.zip could not be unpacked');
  });
});
