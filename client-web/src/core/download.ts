// Files that the page hands to its viewer.

/** Hands a file to the browser's downloads. */
export function download(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  // The download holds the data once it has started, which takes a turn of the event loop or more.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Named by the moment: "froxel-2026-11-28T03-10-00.png". */
export function fileName(extension: string): string {
  const stamp = new Date().toISOString().slice(0, 19).replaceAll(':', '-');
  return `froxel-${stamp}.${extension}`;
}
