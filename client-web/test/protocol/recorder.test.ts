import { readFileSync } from 'node:fs';

import { beforeEach, describe, expect, it } from 'vitest';

import type { ClientBody } from '../../src/protocol/framing';
import { Recorder } from '../../src/protocol/recorder';
import { scriptText } from '../../src/protocol/script_file';

let now: number;
let recorder: Recorder;
const size = (width: number): ClientBody => ({ case: 'setSize', value: { width, height: 180 } });

beforeEach(() => {
  now = 1000;
  recorder = new Recorder(() => now);
});

describe('Recorder', () => {
  it('Idle_RecordsNothing', () => {
    recorder.sent(size(320));
    expect(recorder.recording).toBe(false);
    expect(scriptText(recorder.stop())).toBe('');
  });

  it('Commands_BecomeJsonLinesWithTheirTimes', () => {
    recorder.start([size(320)]);
    now += 250.4;
    recorder.sent({ case: 'setLights', value: { count: 500, animate: false } });
    expect(recorder.recording).toBe(true);
    expect(scriptText(recorder.stop())).toBe(
      '{"at_ms":0,"setSize":{"width":320,"height":180}}\n' +
        '{"at_ms":250,"setLights":{"count":500,"animate":false}}\n',
    );
    expect(recorder.recording).toBe(false);
  });

  it('HelloAckAndPing_AreTheReplayersOwn', () => {
    recorder.start([]);
    recorder.sent({ case: 'hello', value: { protocolMajor: 1 } });
    recorder.sent({ case: 'ack', value: { frameId: 1n } });
    recorder.sent({ case: 'ping', value: {} });
    expect(scriptText(recorder.stop())).toBe('');
  });

  it('SecondStart_BeginsAfresh', () => {
    recorder.start([]);
    recorder.sent(size(320));
    recorder.stop();
    now = 5000;
    recorder.start([]);
    recorder.sent(size(640));
    expect(scriptText(recorder.stop())).toBe('{"at_ms":0,"setSize":{"width":640,"height":180}}\n');
  });

  it('Full_TakesNoMore', () => {
    recorder = new Recorder(() => now, 3);
    recorder.start([]);
    for (let i = 0; i < 3; ++i) recorder.sent(size(320));
    expect(recorder.full).toBe(true);
    recorder.sent(size(640));
    expect(scriptText(recorder.stop()).includes('640')).toBe(false);
  });

  // The C++ tests play this very file with `froxel load --script`.
  it('CommittedRecording_IsWhatItWrites', () => {
    recorder.start([
      size(320),
      { case: 'setRenderer', value: { renderer: 2 } },
      { case: 'setLights', value: { count: 40, animate: true, speed: 0.5 } },
    ]);
    for (let step = 1; step <= 8; ++step) {
      now += 100;
      const eye = { x: 4 * Math.cos(step), y: 2, z: 4 * Math.sin(step) };
      recorder.sent({ case: 'setCamera', value: { eye, target: { x: 0, y: 1, z: 0 } } });
    }
    now += 50;
    recorder.sent({ case: 'setExposure', value: { exposure: 1.5 } });
    const file = new URL('../../../tests/load/recorded.jsonl', import.meta.url);
    expect(scriptText(recorder.stop())).toBe(readFileSync(file, 'utf8'));
  });
});
