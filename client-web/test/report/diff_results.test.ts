import { readFileSync } from 'node:fs';

import { describe, expect, it } from 'vitest';

import { readDiff } from '../../report/diff_results';
import { kDiffSamplePath } from './fakes';

describe('readDiff', () => {
  it('Folders_AreRead', () => {
    const { pairs, failed } = readDiff(readFileSync(kDiffSamplePath, 'utf8'));
    expect(failed).toBe(2);
    expect(pairs.map(({ name, failed: bad }) => [name, bad])).toEqual([
      ['equal.png', false],
      ['nave.png', true],
      ['only.png', true],
    ]);
    expect(pairs[1]?.difference?.flip).toBeGreaterThan(0);
    expect(pairs[2]?.difference).toBeNull();
  });

  it('EmptyTemplateAndOtherSchemas_AreRefusedInWords', () => {
    expect(() => readDiff('null')).toThrow('froxel diff --report');
    expect(() => readDiff('{"schema": "froxel.bench.v1"}')).toThrow('schema "froxel.bench.v1"');
  });
});
