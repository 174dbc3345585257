import { describe, expect, it } from 'vitest';

import { axisText, bytes, count, gridText, ms, percent, tidy, timeText } from '../../src/core/format';

describe('format', () => {
  it('Milliseconds_HaveThreeDigitsOrSo', () => {
    expect([0, 1.234, 12.34, 123.4, null].map(ms)).toEqual(['0.00', '1.23', '12.3', '123', '–']);
  });

  it('TimeThatOughtToBeThere_IsUnknown', () => {
    expect([0, 12.34, null].map(timeText)).toEqual(['0.00', '12.3', 'unknown']);
  });

  it('Bytes_HaveAUnit', () => {
    expect([0, 999, 1500, 2.5e6, 3e12].map(bytes)).toEqual([
      '0 B',
      '999 B',
      '1.5 kB',
      '2.5 MB',
      '3000 GB',
    ]);
  });

  it('GridsAndShares_ReadAsPeopleWriteThem', () => {
    expect(gridText({ x: 16, y: 9, z: 24 })).toBe('16 × 9 × 24');
    expect([percent(1, 3), percent(0, 5), percent(1, 0)]).toEqual(['33.3 %', '0.00 %', '–']);
  });

  it('Tidy_RoundsFloatsButNoWholeNumbers', () => {
    expect(tidy(Math.fround(0.1))).toBe(0.1);
    expect(tidy(123_456_789)).toBe(123_456_789);
  });

  it('Counts_AreGroupedByThree', () => {
    expect(count(1_234_567n)).toBe('1\u2009234\u2009567');
    expect(count(12)).toBe('12');
  });
});

describe('axisText', () => {
  it('HasAUnit_AndIsShortHoweverLongTheTime', () => {
    expect([0, 500, 9_500, 10_000, 250_000].map(axisText)).toEqual(['0 ms', '500 ms', '9500 ms', '10 s', '250 s']);
  });
});
