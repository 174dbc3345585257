// Whether parts of the page are open, as this browser keeps it for the next visit; where it forbids
// that, they are closed then.

export type Part = 'settings' | 'figures';

const key = (part: Part): string => `froxel.${part}`;

export function wasOpen(part: Part): boolean {
  try {
    return localStorage.getItem(key(part)) === 'open';
  } catch {
    return false;
  }
}

export function keepOpen(part: Part, open: boolean): void {
  try {
    localStorage.setItem(key(part), open ? 'open' : 'closed');
  } catch {
    // forbidden or full
  }
}
