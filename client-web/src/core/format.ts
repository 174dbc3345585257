// Numbers as people read them.

/** Milliseconds with three significant digits or so; an en dash for none. */
export function ms(value: number | null): string {
  if (value === null) return '–';
  return value < 9.95 ? value.toFixed(2) : value < 99.5 ? value.toFixed(1) : value.toFixed(0);
}

/** A round time along an axis, in few letters however long it is. */
export const axisText = (value: number): string => (value < 10_000 ? `${value} ms` : `${value / 1000} s`);

/** The same of a time that ought to be there. */
export const timeText = (value: number | null): string => (value === null ? 'unknown' : ms(value));

const kUnits = ['B', 'kB', 'MB', 'GB'] as const;

export function bytes(value: number): string {
  const power = value < 1 ? 0 : Math.min(kUnits.length - 1, Math.floor(Math.log10(value) / 3));
  const scaled = value / 1000 ** power;
  return `${power > 0 && scaled < 99.5 ? scaled.toFixed(1) : scaled.toFixed(0)} ${kUnits[power]}`;
}

export const bits = (value: number): string => bytes(value).replace('B', 'bit');

/** Digits in groups of three, parted by thin spaces. */
export function count(value: number | bigint): string {
  return String(value).replace(/\B(?=(\d{3})+$)/g, '\u2009');
}

/** A cluster grid as people write it. */
export const gridText = ({ x, y, z }: { x: number; y: number; z: number }): string =>
  `${x} × ${y} × ${z}`;

/** Parts of a whole in percent; an en dash for parts of nothing. */
export const percent = (part: number, whole: number): string =>
  whole > 0 ? `${((part / whole) * 100).toPrecision(3)} %` : '–';

/** At most seven significant digits, what a 32-bit float holds; whole numbers as they are. */
export const tidy = (value: number): number =>
  Number.isInteger(value) ? value : Number(value.toPrecision(7));

/** A thing of the scene by its place in a list, from 0: "2 walk". */
export const numberedName = (name: string, index: number): string =>
  `${index + 1} ${name === '' ? '(nameless)' : name}`;

/** Of whatever was thrown. */
export const messageOf = (error: unknown): string => (error instanceof Error ? error.message : '');
