// What one can do on the page and what can be set, as search, keys, tools and the help have it.

export interface Entry {
  readonly title: string;
  /** A sentence that stands alone; may be empty. */
  readonly help: string;
  /** The key that runs it while the picture has the focus, as `KeyboardEvent.key`; empty: none. */
  readonly key: string;
  /** Other words that people look for it by. */
  readonly words: string;
  run(): void;
}

/** The key as people read it. */
export const keyText = ({ key }: Entry): string => (key === ' ' ? 'Space' : key.toUpperCase());

/** The entry of a key; letters in either case. */
export const entryOf = (key: string, entries: readonly Entry[]): Entry | undefined =>
  entries.find((entry) => entry.key !== '' && entry.key === key.toLowerCase());

/** For a search: in small letters, and one text for each way to write an accent. */
export const folded = (text: string): string => text.normalize('NFC').toLowerCase();

/** How well an entry answers, best first: by its title's beginning, its title, a word, its help. */
function rank({ title, help, words }: Entry, text: string): number {
  const [name, more, rest] = [folded(title), folded(words), folded(help)];
  if (name.startsWith(text)) return 0;
  if (` ${name}`.includes(` ${text}`)) return 1;
  if (name.includes(text)) return 2;
  if (more.includes(text)) return 3;
  if (rest.includes(text)) return 4;
  const parts = text.split(/\s+/);
  return parts.every((part) => `${name} ${more} ${rest}`.includes(part)) ? 5 : Infinity;
}

/** Those that have what was typed in them, best first; all of them for nothing. */
export function searched(entries: readonly Entry[], typed: string): Entry[] {
  const text = folded(typed.trim());
  return entries
    .map((entry) => ({ entry, rank: rank(entry, text) }))
    .filter((found) => found.rank < Infinity)
    .sort((a, b) => a.rank - b.rank)
    .map(({ entry }) => entry);
}
