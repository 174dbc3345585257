import { readFileSync } from 'node:fs';

import { describe, expect, it } from 'vitest';

import { readLoad } from '../../report/load_results';
import { kLoadSamplePath } from './fakes';

describe('readLoad', () => {
  it('Run_IsRead', () => {
    const results = readLoad(readFileSync(kLoadSamplePath, 'utf8'));
    expect(results.each).toHaveLength(results.viewers);
    expect(results.requirements.map(({ held }) => held)).toEqual([true, false, true, true]);
    expect(results.series.at(0)?.viewers).toBe(1);
  });

  it('EmptyTemplateAndOtherSchemas_AreRefusedInWords', () => {
    expect(() => readLoad('null')).toThrow('froxel load --report');
    expect(() => readLoad('{"schema": "froxel.bench.v1"}')).toThrow('schema "froxel.bench.v1"');
  });
});
