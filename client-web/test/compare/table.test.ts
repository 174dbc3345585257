import { describe, expect, it } from 'vitest';

import { table, unexplained, withTable, type Row } from '../../compare/table';

const row = (name: string, flip: number, why?: string): Row => ({ name, flip, drawn: 0.2, mssim: 0.98765, why });

describe('table', () => {
  it('Rows_HaveTheirNumbersAndReason_AndSayWhereNoneIsKnown', () => {
    const lines = table([row('near', 0.01, 'glass'), row('even', 0.05), row('odd', 0.0501)]).split('\n');
    expect(lines.slice(2)).toEqual([
      '| near | 0.010 | 0.050 | 0.988 | glass |',
      '| even | 0.050 | 0.250 | 0.988 | |',
      '| odd | 0.050 | 0.251 | 0.988 | not known |',
    ]);
  });

  it('Unexplained_NamesRowsThatDifferWithoutAReason', () => {
    expect(unexplained([row('a', 0.04), row('b', 0.06), row('c', 0.06, 'glass')])).toEqual(['b']);
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
