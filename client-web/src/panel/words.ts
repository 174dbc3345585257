// What the panel says of its fields: the server's words for the settings of its table, and words of
// the page's own for what stands beside it.

export interface Words {
  readonly label: string;
  readonly help: string;
  readonly unit: string;
  readonly cost: string;
  readonly compares: boolean; // the sides of a comparison may have it otherwise
}

/** By the fields' names. */
export type WordBook = ReadonlyMap<string, Words>;

interface OwnWords {
  readonly label: string;
  readonly help: string;
}

const kOwnWords: ReadonlyMap<string, OwnWords> = new Map([
  ['fov_deg', { label: 'Field of view, deg', help: 'Vertical angle that the picture covers' }],
  [
    'lens_shift.x',
    {
      label: 'Lens shift sideways',
      help: 'Shifts the picture’s centre to the right of the view axis, in half widths',
    },
  ],
  [
    'lens_shift.y',
    {
      label: 'Lens shift upwards',
      help: 'Shifts the picture’s centre above the view axis, in half heights; keeps verticals straight',
    },
  ],
  [
    'grid.auto',
    {
      label: 'Automatic grid',
      help: 'The server chooses the cluster grid; off: tiles and slices as set here',
    },
  ],
  [
    'animation',
    { label: 'Animation number', help: 'Number of the scene’s animation, from 1; 0: none' },
  ],
  [
    'material_variant',
    { label: 'Variant', help: 'Material variant of the scene’s file' },
  ],
  ['grid.x', { label: 'Tiles across', help: 'Number of clusters along the picture’s width' }],
  ['grid.y', { label: 'Tiles down', help: 'Number of clusters along the picture’s height' }],
  ['grid.z', { label: 'Slices in depth', help: 'Number of clusters along the view’s depth' }],
  [
    'debug_frozen',
    {
      label: 'Freeze clusters',
      help: 'Freezes this camera’s cluster grid for the cluster wires while the view moves; the host builds a second grid',
    },
  ],
]);

/** "Fog base height, m" of fog_base_height; the name in words of a server that tells no label. */
export function labelOf(name: string, book: WordBook): string {
  const own = kOwnWords.get(name);
  if (own) return own.label;
  const words = book.get(name);
  const told = words?.label ?? '';
  const text = told === '' ? name.replaceAll('_', ' ') : told;
  const label = `${text.charAt(0).toUpperCase()}${text.slice(1)}`;
  return words?.unit ? `${label}, ${words.unit}` : label;
}

/** What a field does, what that costs, and its limits, as far as they are known. */
export function tipOf(name: string, book: WordBook, limits: string): string {
  const words = book.get(name);
  const help = kOwnWords.get(name)?.help ?? words?.help ?? '';
  const cost = words?.cost ?? '';
  return [help, cost && `Costs: ${cost}`, limits].filter((part) => part !== '').join(' · ');
}

const kNone: WordBook = new Map();

/** The server's words; what is not as it should be is left out. */
export function wordsOf(json: unknown): WordBook {
  if (!Array.isArray(json)) return kNone;
  return new Map(
    json.flatMap((entry: unknown) => {
      if (typeof entry !== 'object' || entry === null) return [];
      const parts = new Map<string, unknown>(Object.entries(entry));
      const text = (key: string): string => {
        const value = parts.get(key);
        return typeof value === 'string' ? value : '';
      };
      const words = {
        label: text('label'),
        help: text('help'),
        unit: text('unit'),
        cost: text('cost'),
        compares: parts.get('compare') === true,
      };
      return text('name') === '' ? [] : [[text('name'), words] as const];
    }),
  );
}

/** Asks the server; without an answer there are no words. */
export async function fetchWords(): Promise<WordBook> {
  try {
    const response = await fetch('settings.json');
    return response.ok ? wordsOf(await response.json()) : kNone;
  } catch {
    return kNone; // no network, or a server that has none
  }
}
