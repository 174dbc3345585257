import { describe, expect, it } from 'vitest';

import { changesOf, rightOf, withChange } from '../../src/settings/comparison';
import { CompareShow } from '../../src/gen/froxel/v1/common_pb';
import { settingCommands } from '../../src/settings/setting_commands';
import { sampleSettings } from '../sample';

describe('comparison', () => {
  it('Text_IsReadAndWritten', () => {
    const changes = [
      { name: 'renderer', text: 'naive' },
      { name: 'list_cap', text: '16' },
    ];
    expect(changesOf('renderer:naive,list_cap:16')).toEqual(changes);
    expect(rightOf(changes)).toBe('renderer:naive,list_cap:16');
    expect(changesOf('')).toEqual([]);
    expect(changesOf('renderer,:5,list_cap:,a:b')).toEqual([{ name: 'a', text: 'b' }]);
  });

  it('Change_TakesThePlaceOfItsName_OrIsTheLast', () => {
    const changes = changesOf('renderer:naive,list_cap:16');
    expect(rightOf(withChange(changes, { name: 'renderer', text: 'forward_plus' }))).toBe('renderer:forward_plus,list_cap:16');
    expect(rightOf(withChange(changes, { name: 'quality', text: '30' }))).toBe('renderer:naive,list_cap:16,quality:30');
  });
});

describe('settingCommands', () => {
  const usual = sampleSettings();
  const compared = { ...usual, compare: 'renderer:naive' };

  it('Comparison_IsBegunShownAndEnded', () => {
    expect(settingCommands(usual, compared)).toEqual([{ case: 'setCompare', value: { right: 'renderer:naive' } }]);
    expect(settingCommands(compared, { ...compared, compareHeatMap: true })).toEqual([
      { case: 'setCompare', value: { show: CompareShow.HEAT_MAP } },
    ]);
    expect(settingCommands(usual, { ...compared, compareHeatMap: true, compareSplit: 0.25 })).toEqual([
      { case: 'setCompare', value: { right: 'renderer:naive', split: 0.25, show: CompareShow.HEAT_MAP } },
    ]);
    expect(settingCommands({ ...compared, compareHeatMap: true }, usual)).toEqual([
      { case: 'setCompare', value: { right: '' } },
    ]);
  });
});
