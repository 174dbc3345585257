// The table of a comparison, and its place in a page.

export interface Row {
  readonly name: string;
  readonly flip: number; // mean LDR-FLIP of the picture
  readonly drawn: number; // the share of its pixels that are not background
  readonly mssim: number;
  readonly around: number | null; // FLIP with light from around alone; null: not drawn
  readonly why?: string | undefined; // why the pictures differ
}

/** Above it a row needs a reason. */
export const kMostFlip = 0.05;

const kHead = '| file | FLIP | over what is drawn | SSIM | around: FLIP | over what is drawn | why |';

const worst = ({ flip, around }: Row): number => Math.max(flip, around ?? 0);

export function table(rows: readonly Row[]): string {
  const lines = rows.map((row) => {
    const { name, flip, drawn, mssim, around, why = worst(row) > kMostFlip ? 'not known' : '' } = row;
    const surroundings = around === null ? [null, null] : [around, around / drawn];
    const numbers = [flip, flip / drawn, mssim, ...surroundings].map((value) => value?.toFixed(3) ?? '–');
    return `| ${[name, ...numbers, why].join(' | ')} |`.replace('|  |', '| |');
  });
  return [kHead, '|---|---|---|---|---|---|---|', ...lines].join('\n');
}

/** Names of files that differ for no known reason. */
export const unexplained = (rows: readonly Row[]): string[] =>
  rows.filter((row) => worst(row) > kMostFlip && row.why === undefined).map(({ name }) => name);

/** The page with its table replaced. */
export function withTable(page: string, newTable: string): string {
  const lines = page.split('\n');
  const begin = lines.indexOf(kHead);
  if (begin < 0) throw new Error(`the page has no line "${kHead}"`);
  const rest = lines.slice(begin).findIndex((line) => !line.startsWith('|'));
  return [...lines.slice(0, begin), newTable, ...(rest < 0 ? [] : lines.slice(begin + rest))].join('\n');
}
