// The right side of a comparison, as the protocol and the address have it: "renderer:naive,list_cap:16".

/** A setting that the right side has otherwise. */
export interface Change {
  readonly name: string;
  readonly text: string; // its value, as in the address
}

/** Empty: nothing is compared. What has no value is left out; the server judges the rest. */
export const changesOf = (right: string): Change[] =>
  right.split(',').flatMap((part) => {
    const [name = '', text = ''] = part.split(':');
    return name !== '' && text !== '' ? [{ name, text }] : [];
  });

export const rightOf = (changes: readonly Change[]): string => changes.map(({ name, text }) => `${name}:${text}`).join(',');

/** The changes with one of that name, in the place of another of it or as the last. */
export function withChange(changes: readonly Change[], change: Change): Change[] {
  const has = changes.some(({ name }) => name === change.name);
  return has ? changes.map((old) => (old.name === change.name ? change : old)) : [...changes, change];
}
