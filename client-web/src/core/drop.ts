// What is dropped on the page, taken within the event: it is gone after it.

export interface Dropped {
  readonly entries: readonly FileSystemEntry[]; // files and folders
  readonly files: readonly File[]; // where a browser gives no entries
}

export const holdsFiles = (transfer: DataTransfer | null): boolean => transfer?.types.includes('Files') ?? false;

export function takeDropped(items: DataTransferItemList): Dropped {
  const entries: FileSystemEntry[] = [];
  const files: File[] = [];
  for (const item of items) {
    if (item.kind !== 'file') continue;
    const entry = item.webkitGetAsEntry();
    const file = entry ? null : item.getAsFile();
    if (entry) entries.push(entry);
    else if (file) files.push(file);
  }
  return { entries, files };
}
