// Files that a person drops on the page or chooses: also whole folders, and zips.

import { unzip, type UnzipFileInfo } from 'fflate';

import type { Dropped } from '../core/drop';

export interface BroughtFile {
  readonly path: string; // with '/', from what was dropped
  readonly blob: Blob;
}

/** More is no scene: the server takes 512. */
const kMostFiles = 100_000;
/** Of what a zip says it holds: more would fill the browser's memory. */
const kMostUnpackedBytes = 2 ** 31;

export async function droppedFiles({ entries, files }: Dropped): Promise<readonly BroughtFile[]> {
  const found: BroughtFile[] = files.map((file) => ({ path: file.name, blob: file }));
  const waiting = [...entries];
  for (let entry = waiting.pop(); entry; entry = waiting.pop()) {
    const path = entry.fullPath.replace(/^\//, '');
    if (isHidden(path)) continue;
    if (found.length + waiting.length >= kMostFiles) throw new Error(`more than ${kMostFiles} files; drop the scene's own folder`);
    if (isFile(entry)) {
      const of = entry;
      found.push({ path, blob: await new Promise<File>((done, failed) => of.file(done, failed)) });
    } else if (isFolder(entry)) {
      waiting.push(...(await entriesOf(entry.createReader())));
    }
  }
  return unpacked(found);
}

const isFile = (entry: FileSystemEntry): entry is FileSystemFileEntry => entry.isFile;
const isFolder = (entry: FileSystemEntry): entry is FileSystemDirectoryEntry => entry.isDirectory;

/** A reader gives a hundred at a time, and none at the end. */
async function entriesOf(reader: FileSystemDirectoryReader): Promise<FileSystemEntry[]> {
  const entries: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((done, failed) => reader.readEntries(done, failed));
    if (some.length === 0) return entries;
    entries.push(...some);
  }
}

export function chosenFiles(list: FileList): Promise<readonly BroughtFile[]> {
  return unpacked(
    Array.from(list, (file) => ({ path: file.webkitRelativePath || file.name, blob: file })).filter(
      ({ path }) => !isHidden(path),
    ),
  );
}

/** What systems put beside files: ".DS_Store", "__MACOSX/". */
function isHidden(path: string): boolean {
  return path.split('/').some((part) => part.startsWith('.') || part === '__MACOSX');
}

/** One zip alone is what it holds. */
async function unpacked(files: readonly BroughtFile[]): Promise<readonly BroughtFile[]> {
  const [only] = files;
  if (!only || files.length > 1 || !only.path.toLowerCase().endsWith('.zip')) return files;
  const packed = new Uint8Array(await only.blob.arrayBuffer());
  let bytes = 0;
  const wanted = ({ name, originalSize }: UnzipFileInfo): boolean => {
    const is = !name.endsWith('/') && !isHidden(name);
    bytes += is ? originalSize : 0;
    return is && bytes <= kMostUnpackedBytes;
  };
  const held = await new Promise<Record<string, Uint8Array>>((done, failed) => {
    unzip(packed, { filter: wanted }, (error, data) => {
      if (error) failed(new Error(`${only.path} could not be unpacked: ${error.message}`));
      else done(data);
    });
  });
  if (bytes > kMostUnpackedBytes) throw new Error(`${only.path} holds more than 2 GiB`);
  // A copy of its own buffer: a Blob takes no shared one.
  return Object.entries(held).map(([path, data]) => ({ path, blob: new Blob([new Uint8Array(data)]) }));
}
