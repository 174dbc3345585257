import { describe, expect, it } from 'vitest';

import { errorPoints, kMetrics, workloadsOf } from '../../report/error_plot';
import { frontRows } from '../../report/error_section';
import { figuresOf } from '../../report/glance';
import { seriesColours, shapesOf } from '../../report/marks';
import { paretoFront } from '../../report/pareto';
import { linesOf, passParts, shares, unknownPasses } from '../../report/part_bars';
import { layoutOf, readResults, speedUp, timeMs } from '../../report/results';
import { referencesOf, timedRows } from '../../report/sweep_plot';
import { durationText, errorText, factorText, psnrText, usualClock } from '../../report/text';
import { errorOf, kNoError, resultsOf, rowOf, sample, sweepOf } from './fakes';

const [kLargest, kFlip] = kMetrics;
if (!kLargest || !kFlip) throw new Error('two metrics');

const kForward = { renderer: 'forward_plus', gbuffer: { normal: 'oct16', position: 'depth' } };

describe('readResults', () => {
  it('CommittedSample_IsRead', () => {
    const results = sample();
    expect(results.sweeps.length).toBeGreaterThan(0);
    for (const { rows } of results.sweeps) {
      for (const row of rows) expect(row.command).toMatch(/^froxel render /);
    }
  });

  it('EmptyTemplate_SaysWhoFillsIt', () => {
    expect(() => readResults('null')).toThrow('froxel bench --report');
  });

  it('OtherSchema_IsNamed', () => {
    expect(() => readResults('{"schema": "froxel.bench.v9"}')).toThrow('froxel.bench.v9');
  });
});

describe('rows', () => {
  it('Layout_IsOfTheGbuffer', () => {
    expect(layoutOf(rowOf('a', 1))).toBe('oct16, depth');
    const gbuffer = { normal: 'oct16', position: 'depth' };
    expect(layoutOf(rowOf('a', 1, { settings: { renderer: 'naive', gbuffer } }))).toBe(
      'no G-buffer',
    );
  });

  it('Time_IsInMilliseconds', () => {
    expect(timeMs(rowOf('a', 12), 'gpu_us')?.median).toBe(12);
    expect(timeMs(rowOf('a', 12, { gpu_us: null }), 'gpu_us')).toBeNull();
  });

  it('SpeedUp_IsAgainstNaiveOfTheSamePicture', () => {
    const gbuffer = { normal: 'oct16', position: 'depth' };
    const naive = rowOf('n', 30, { series: 'naive', settings: { renderer: 'naive', gbuffer } });
    const slower = { ...rowOf('m', 90), series: 'naive, fragment', settings: naive.settings };
    const ours = rowOf('c', 10);
    const other = rowOf('o', 10, { workload: 'another picture' });
    const sweep = sweepOf([slower, naive, ours, other]);
    expect(speedUp(ours, sweep, 'gpu_us')).toBe(3);
    expect(speedUp(naive, sweep, 'gpu_us')).toBeNull();
    expect(speedUp(other, sweep, 'gpu_us')).toBeNull();
  });

  it('UsualClock_IsTheDevices', () => {
    const sweeps = [sweepOf([rowOf('a', 1)])];
    const device = { ...sample().device, kind: 'gpu' };
    expect(usualClock(resultsOf(sweeps))).toBe('cpu_us');
    expect(usualClock(resultsOf(sweeps, { device }))).toBe('gpu_us');
    expect(usualClock(resultsOf([sweepOf([rowOf('a', 1, { cpu_us: null, gpu_us: null })])]))).toBe(
      'frame_us',
    );
  });
});

describe('speed against error', () => {
  const exact = rowOf('exact', 20, { error_r2: errorOf(0, 0) });
  const fast = rowOf('fast', 5, { error_r2: errorOf(1, 0.2) });
  const beaten = rowOf('beaten', 25, { error_r2: errorOf(2, 0.1) });
  const unknown = rowOf('unknown', 1, { error_r2: kNoError });
  const elsewhere = rowOf('elsewhere', 1, { workload: 'another picture' });
  const sweeps = [
    sweepOf([exact, fast]),
    sweepOf([beaten, unknown, elsewhere], { name: 'gbuffer' }),
  ];

  it('RowsOfTheStream_AreLeftOut', () => {
    const stream = sample().sweeps.flatMap(({ rows }) =>
      rows.flatMap((row) => row.stream ?? []),
    )[0];
    if (!stream) throw new Error('the sample has a stream');
    const encoded = [sweepOf([rowOf('quality 80', 1, { stream })])];
    expect(errorPoints(encoded, 'a picture', kLargest, 'gpu_us')).toEqual([]);
    expect(workloadsOf(encoded, 'gpu_us')).toEqual([]);
  });

  it('Points_AreOfOnePictureWithTimeAndError', () => {
    const points = errorPoints(sweeps, 'a picture', kLargest, 'gpu_us');
    expect(points.map(({ row }) => row.label)).toEqual(['exact', 'fast', 'beaten']);
  });

  it('Workloads_AreThoseWithMostRowsFirst', () => {
    expect(workloadsOf(sweeps, 'gpu_us')).toEqual([
      { name: 'a picture', rows: 3 },
      { name: 'another picture', rows: 1 },
    ]);
  });

  it('FrontRows_JoinBothMetrics', () => {
    const fronts = [kLargest, kFlip].map((metric) =>
      paretoFront(errorPoints(sweeps, 'a picture', metric, 'gpu_us')),
    );
    const rows = frontRows(fronts);
    expect(rows.map(({ point, numbers }) => [point.row.label, ...numbers])).toEqual([
      ['fast', 1, 1],
      ['exact', 2, 2],
    ]);
  });
});

describe('sweeps', () => {
  it('RowsWithoutTheClock_AreNotPlotted', () => {
    const sweep = sweepOf([rowOf('a', 1), rowOf('b', 1, { gpu_us: null })]);
    expect(timedRows(sweep, 'gpu_us').map(({ label }) => label)).toEqual(['a']);
  });

  it('PublishedFigures_StandWhereVariableAndSweepFit', () => {
    const line = {
      source: 'them',
      hardware: 'theirs',
      sweep: 'light_count',
      series: 'naive',
      variable: 'lights',
      note: '',
      rows: [
        { value: 50, ms: 10, published: '100 FPS' },
        { value: 60, ms: null, published: 'twice as fast' },
      ],
    };
    const sweep = sweepOf([]);
    expect(referencesOf(sweep, [line])).toMatchObject([
      { value: 50, ms: 10, line: 'them, theirs' },
    ]);
    expect(referencesOf(sweep, [{ ...line, variable: 'radius' }])).toEqual([]);
    expect(referencesOf(sweepOf([], { axis: 'category' }), [line])).toEqual([]);
  });

  it('Bars_StandUnderTheirSeries', () => {
    const sweep = sweepOf([
      rowOf('1', 1, { series: 'naive' }),
      rowOf('2', 1),
      rowOf('3', 1, { series: 'naive' }),
    ]);
    const lines = linesOf(passParts(sweep)).map(({ heading, label }) => heading ?? label);
    expect(lines).toEqual(['naive', '1', '3', 'clustered deferred', '2']);
  });

  it('RowWithAnUnknownPass_HasNoBar_AndThePassIsNamed', () => {
    const known = rowOf('known', 1);
    const passes = [...known.passes, { name: 'readback', gpu_us: null }];
    const sweep = sweepOf([known, rowOf('unknown', 1, { passes })]);
    expect(passParts(sweep).map(({ label }) => label)).toEqual(['known']);
    expect(unknownPasses(sweep)).toEqual(['readback']);
    expect(unknownPasses(sweepOf([known]))).toEqual([]);
  });

  it('BarsOfOneSeries_NeedNoHeading', () => {
    expect(
      linesOf(passParts(sweepOf([rowOf('1', 1), rowOf('2', 1)]))).map(({ heading }) => heading),
    ).toEqual([null, null]);
  });

  it('Shares_AddUpTo100', () => {
    const parts = ['a', 'b', 'c'].map((name, index) => ({
      series: 's',
      label: 'l',
      name,
      value: index + 1,
    }));
    const sum = shares(parts).reduce((total, { value }) => total + value, 0);
    expect(sum).toBeCloseTo(100, 9);
    expect(shares([{ series: 's', label: 'l', name: 'a', value: 0 }])[0]?.value).toBe(0);
  });
});

describe('head', () => {
  it('InexactRow_IsShownAsBad', () => {
    const results = resultsOf([
      sweepOf([
        rowOf('a', 1),
        rowOf('b', 1, { error_r1: errorOf(0.1, 0.1) }),
        rowOf('c', 1, { error_r1: kNoError }),
      ]),
    ]);
    expect(figuresOf(results)[0]).toMatchObject({
      value: '1 of 2',
      bad: true,
      about: 'not compared: 1',
    });
  });

  it('Flip_IsTheWorstOfDefaultSettings', () => {
    const results = resultsOf([
      sweepOf([
        rowOf('a', 1, { error_r2: errorOf(0.1, 0.002) }),
        rowOf('b', 1, { settings: kForward, error_r2: errorOf(1, 0.5) }),
      ]),
      sweepOf([rowOf('c', 1, { error_r2: errorOf(1, 0.9) })], { name: 'gbuffer' }),
    ]);
    expect(figuresOf(results)[1]?.value).toBe('0.002');
  });
});

describe('marks', () => {
  it('Renderers_KeepTheirColours', () => {
    expect(seriesColours(['444', 'clustered_deferred']).get('clustered_deferred')).toBe(
      seriesColours(['clustered_deferred']).get('clustered_deferred'),
    );
  });

  it('Series_HaveDifferentColours', () => {
    const names = ['naive', 'forward_plus', 'a', 'b', 'c', 'd'];
    expect(new Set(seriesColours(names).values()).size).toBe(names.length);
  });

  it('WaysOfARenderer_HaveShadesOfItsColour', () => {
    const colours = seriesColours([
      'forward_plus, compute',
      'forward_plus, fragment',
      'forward_plus',
    ]);
    expect([...colours.values()]).toEqual(['var(--c1)', 'var(--c1b)', 'var(--c1)']);
  });

  it('TwelveNames_HaveDifferentShapes', () => {
    const names = Array.from({ length: 12 }, (_, i) => String(i));
    const paths = [...shapesOf(names).values()].map(({ path }) => path);
    expect(new Set(paths).size).toBe(12);
  });
});

describe('text', () => {
  it('Errors_HaveThreeDigits', () => {
    expect([0, 0.0123456, 2.345e-5, 12.3456, null].map(errorText)).toEqual([
      '0',
      '0.0123',
      '2.3e-5',
      '12.3',
      '–',
    ]);
  });

  it('Psnr_OfEqualPictures_IsAWord', () => {
    expect(psnrText(errorOf(0, 0))).toBe('equal');
    expect(psnrText(errorOf(0.1, 0))).toBe('60.0');
    expect(psnrText(kNoError)).toBe('–');
  });

  it('Factors_AndDurations_AreShort', () => {
    expect([1.234, 23.45, 123.4, null].map(factorText)).toEqual(['1.23×', '23.4×', '123×', '–']);
    expect([1.04, 59, 600, 9000].map(durationText)).toEqual([
      '1 s',
      '59 s',
      '10 min',
      '2 h 30 min',
    ]);
  });
});
