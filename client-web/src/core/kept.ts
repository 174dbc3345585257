// What this browser keeps for the next visit: which parts of the page are open, and which hints were
// seen. Where it forbids that, parts are closed and hints come again.

export type Part = 'settings' | 'figures';
export type Hint = 'drag-hint';

function read(key: Part | Hint): string | null {
  try {
    return localStorage.getItem(`froxel.${key}`);
  } catch {
    return null;
  }
}

function write(key: Part | Hint, value: string): void {
  try {
    localStorage.setItem(`froxel.${key}`, value);
  } catch {
    // forbidden or full
  }
}

export const wasOpen = (part: Part): boolean => read(part) === 'open';
export const keepOpen = (part: Part, open: boolean): void => write(part, open ? 'open' : 'closed');

export const wasSeen = (hint: Hint): boolean => read(hint) === 'seen';
export const keepSeen = (hint: Hint): void => write(hint, 'seen');
