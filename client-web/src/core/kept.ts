// Whether parts of the page are open, as this browser keeps it for the next visit; where it forbids
// that, they are closed then.

const key = (part: string): string => `froxel.${part}`;

export function wasOpen(part: string): boolean {
  try {
    return localStorage.getItem(key(part)) === 'open';
  } catch {
    return false;
  }
}

export function keepOpen(part: string, open: boolean): void {
  try {
    localStorage.setItem(key(part), open ? 'open' : 'closed');
  } catch {
    // forbidden or full
  }
}
