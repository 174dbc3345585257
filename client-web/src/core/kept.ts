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

/** A scene that was brought from here; its key may remove it. */
export interface BroughtScene {
  readonly id: string;
  readonly ownerKey: string;
  readonly name: string;
}
const kBrought = 'froxel.brought';
const kMostBrought = 50;

function broughtScenes(): readonly BroughtScene[] {
  try {
    const kept: unknown = JSON.parse(localStorage.getItem(kBrought) ?? '[]');
    return Array.isArray(kept) ? (kept as readonly BroughtScene[]) : [];
  } catch {
    return [];
  }
}

export const broughtScene = (id: string): BroughtScene | null => broughtScenes().find((one) => one.id === id) ?? null;

/** `scene` is null: it is no more. */
export function keepBrought(id: string, scene: BroughtScene | null): void {
  const others = broughtScenes().filter((one) => one.id !== id);
  try {
    localStorage.setItem(kBrought, JSON.stringify([...(scene ? [scene] : []), ...others].slice(0, kMostBrought)));
  } catch {
    // forbidden or full
  }
}
