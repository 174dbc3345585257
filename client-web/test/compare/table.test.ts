import { describe, expect, it } from 'vitest';

import { table, unexplained, withTable, type Row } from '../../compare/table';

const row = (name: string, flip: number, why?: string, around: number | null = null): Row => ({
  name,
  flip,
  drawn: 0.2,
  mssim: 0.98765,
  around,
  why,
});

describe('table', () => {
  it('Rows_HaveTheirNumbersAndReason_AndSayWhereNoneIsKnown', () => {
    const rows = [
      row('near', 0.01, 'glass', 0.02),
      row('even', 0.05),
      row('odd', 0.0501),
      row('lit', 0.01, undefined, 0.06),
    ];
    expect(table(rows).split('\n').slice(2)).toEqual([
      '| near | 0.010 | 0.050 | 0.988 | 0.020 | 0.100 | glass |',
      '| even | 0.050 | 0.250 | 0.988 | – | – | |',
      '| odd | 0.050 | 0.251 | 0.988 | – | – | not known |',
      '| lit | 0.010 | 0.050 | 0.988 | 0.060 | 0.300 | not known |',
    ]);
  });

  it('Unexplained_NamesRowsThatDifferWithoutAReason', () => {
    const rows = [row('a', 0.04), row('b', 0.06), row('c', 0.06, 'glass'), row('d', 0, undefined, 0.06)];
    expect(unexplained(rows)).toEqual(['b', 'd']);
  });

  it('WithTable_ReplacesTheTableAlone', () => {
    const other = '| file |\n|---|\n| kept |';
    const before = `# Title\n\n${other}\n\n${table([row('a', 0.01), row('b', 0.02)])}\n\nend\n`;
    const after = withTable(before, table([row('c', 0.03)]));
    expect(after).toBe(`# Title\n\n${other}\n\n${table([row('c', 0.03)])}\n\nend\n`);
    expect(withTable(after, table([row('c', 0.03)]))).toBe(after);
  });

  it('WithTable_OnAPageWithoutOne_IsRefused', () => {
    expect(() => withTable('# Title\n', table([]))).toThrow('the page has no line "| file | FLIP');
  });
});
