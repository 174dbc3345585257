import { describe, expect, it } from 'vitest';

import { clockText, hasEnded, namesOf, toggled } from '../../src/cards/animation_card';
import { Repeat } from '../../src/gen/froxel/v1/common_pb';
import { sampleSettings } from '../sample';

const playing = sampleSettings({ animation: 1, animationPlaying: true, animationSpeed: 1 });
const once = { ...playing, animationRepeat: Repeat.ONCE };

describe('the animation card', () => {
  it('Names_AreNumberedAndBeginWithNone', () => {
    expect(namesOf([{ name: 'Walk' }, { name: '' }])).toEqual(['none', '1 Walk', '2 (nameless)']);
  });

  it('Clock_IsMinutesAndTenths', () => {
    expect(clockText(0, 1.5)).toBe('0:00.0 / 0:01.5');
    expect(clockText(59.99, 125)).toBe('0:59.9 / 2:05.0');
    expect(clockText(0.3, 0.3)).toBe('0:00.3 / 0:00.3'); // 0.3 * 10 is a little below 3
  });

  it('Button_PausesAndGoesOn', () => {
    expect(toggled(playing, 0.5, 2)).toEqual({ animationPlaying: false });
    expect(toggled({ ...playing, animationPlaying: false }, 0.5, 2)).toEqual({
      animationPlaying: true,
    });
  });

  it('Button_AfterTheEnd_BeginsAnew', () => {
    expect(hasEnded(once, 1.9, 2)).toBe(false);
    expect(hasEnded(once, 2, 2)).toBe(true);
    expect(hasEnded(playing, 2, 2)).toBe(false);
    expect(toggled(once, 2, 2)).toEqual({ animationPlaying: true, animationTime: 0 });
    const back = { ...once, animationSpeed: -1 };
    expect(hasEnded(back, 2, 2)).toBe(false);
    expect(toggled(back, 0, 2)).toEqual({ animationPlaying: true, animationTime: 2 });
  });
});
