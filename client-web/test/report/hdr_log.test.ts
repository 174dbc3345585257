// The log of tests/unit/load/hdr_log_test.cpp, as HdrHistogram's own reader understands it.

import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

import { HistogramLogReader, type Histogram } from 'hdr-histogram-js';
import { describe, expect, it } from 'vitest';

const kLog = fileURLToPath(new URL('../../../tests/unit/load/samples.hlog', import.meta.url));

/** The samples of that test, in microseconds, as the log counts them. */
const samples = (): number[] => {
  const found = [1, 1, 3_600_000_000];
  for (let power = 0; power < 33; power += 1) {
    for (let step = 0; step < 3; step += 1) {
      const us = Math.round(2 ** power * (1 + step / 3));
      found.push(Math.min(Math.max(us, 1), 3_600_000_000));
    }
  }
  return found.sort((a, b) => a - b);
};

function readAll(): Map<string, Histogram> {
  const reader = new HistogramLogReader(readFileSync(kLog, 'utf8'));
  const found = new Map<string, Histogram>();
  for (let next = reader.nextIntervalHistogram(); next; next = reader.nextIntervalHistogram()) {
    found.set(next.tag, next);
  }
  return found;
}

describe('hdr log', () => {
  it('EverySample_IsRead_ToThreeDigits', () => {
    const latency = readAll().get('latency');
    const expected = samples();
    expect(latency?.totalCount).toBe(expected.length);
    for (const [index, value] of expected.entries()) {
      const read = latency?.getValueAtPercentile(((index + 0.5) / expected.length) * 100) ?? 0;
      expect(Math.abs(read - value) / value, `sample ${index}`).toBeLessThan(1e-3);
    }
  });

  it('HistogramsOfTwoMachines_AddUp', () => {
    const sum = readAll().get('latency');
    const other = readAll().get('reaction');
    if (!sum || !other) throw new Error('the log has both');
    const before = sum.totalCount;
    sum.add(other);
    expect(sum.totalCount).toBe(before + 1);
    expect(other.getValueAtPercentile(50)).toBeCloseTo(12_345, -2);
  });
});
