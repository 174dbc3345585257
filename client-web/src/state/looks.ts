// Looks: named presets of lights, environment and renderer, as fragments of the address. The server
// offers some, and a browser keeps those of its viewers.

import { formatOnly, parseAddress } from './address';
import type { ServerInfo } from './app_state';
import type { Settings } from '../settings/settings';

export interface Look {
  readonly name: string; // unique
  readonly label: string;
  readonly help: string;
  readonly address: string;
  readonly own: boolean; // kept in this browser
}

const kKept = 'froxel.looks';
const kMostKept = 50;
const kLongestName = 40;

export const offeredLooks = (server: ServerInfo | null): Look[] =>
  (server?.looks ?? []).map(({ name, label, help, address }) => ({ name, label, help, address, own: false }));

/** What of `settings` a look of this server would set. Empty: it offers none. */
export function lookAddress(server: ServerInfo, settings: Settings): string {
  const names = new Set(new URLSearchParams(server.looks[0]?.address ?? '').keys());
  return formatOnly(settings, names);
}

/** Whether these settings are all that the look sets. */
export const isLook = (look: Look, settings: Settings): boolean =>
  Object.entries(parseAddress(look.address).settings).every(([key, value]) =>
    sameShown(value, settings[key as keyof Settings]),
  );

/** The server's numbers are 32-bit floats, of which an address has the shortest text. */
function sameShown(a: unknown, b: unknown): boolean {
  if (typeof a === 'number' && typeof b === 'number') return Math.fround(a) === Math.fround(b);
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return a === b;
  return Object.entries(a).every(([key, part]) => sameShown(part, (b as Record<string, unknown>)[key]));
}

/** Those kept in this browser, oldest first; what it holds that is none is passed over. */
export function ownLooks(): Look[] {
  let kept: unknown;
  try {
    kept = JSON.parse(localStorage.getItem(kKept) ?? '[]');
  } catch {
    return []; // forbidden, or of another program
  }
  return (Array.isArray(kept) ? kept : []).flatMap((entry: unknown) => {
    const { label, address } = (entry ?? {}) as { label?: unknown; address?: unknown };
    if (typeof label !== 'string' || typeof address !== 'string' || label === '') return [];
    return [{ name: `own:${label}`, label, help: 'A look of your own', address, own: true }];
  });
}

/** In place of one with that label. Why not, in words; null: it is kept. */
export function keepLook(label: string, address: string): string | null {
  const name = label.trim();
  if (name === '' || name.length > kLongestName) {
    return `a look's name has 1 to ${kLongestName} letters`;
  }
  const others = ownLooks().filter((look) => look.label !== name);
  if (others.length >= kMostKept) {
    return `${kMostKept} looks are kept in this browser; remove one of them`;
  }
  return write([...others, { label: name, address }]);
}

/** As keepLook(). */
export const dropLook = (label: string): string | null =>
  write(ownLooks().filter((look) => look.label !== label));

function write(looks: readonly Pick<Look, 'label' | 'address'>[]): string | null {
  try {
    localStorage.setItem(kKept, JSON.stringify(looks.map(({ label, address }) => ({ label, address }))));
    return null;
  } catch {
    return 'this browser stores nothing for this page: storage is forbidden or full';
  }
}
