import { describe, expect, it } from 'vitest';

import { Chroma, LightingStage, Renderer, ToneMap } from '../src/gen/froxel/v1/common_pb';
import { cameraCommand, settingCommands, settingsOf, type Settings } from '../src/settings';
import { kBounds, sampleSettings, viewState } from './sample';

const base = sampleSettings();
const commandsFor = (change: Partial<Settings>): unknown =>
  settingCommands(base, { ...base, ...change });

describe('settingsOf', () => {
  it('LightBox_ThatIsTheScenesBounds_IsNone', () => {
    expect(base.lightBox).toBeNull();
    const box = { min: { x: 0, y: 0, z: 0 }, max: { x: 1, y: 1, z: 1 } };
    expect(settingsOf(viewState({ lightBox: box }), kBounds).lightBox).toEqual(box);
  });
});

describe('settingCommands', () => {
  it('NoChange_NoCommand', () => {
    expect(commandsFor({})).toEqual([]);
  });

  it.each<[string, Partial<Settings>, unknown]>([
    ['size', { width: 100 }, { case: 'setSize', value: { width: 100, height: 540 } }],
    [
      'renderer',
      { renderer: Renderer.NAIVE },
      { case: 'setRenderer', value: { renderer: Renderer.NAIVE } },
    ],
    [
      'lighting stage, with the renderer it belongs to',
      { lighting: LightingStage.FRAGMENT },
      {
        case: 'setRenderer',
        value: { renderer: Renderer.CLUSTERED_DEFERRED, lighting: LightingStage.FRAGMENT },
      },
    ],
    ['light count', { lights: 0 }, { case: 'setLights', value: { count: 0 } }],
    ['light radius', { lightRadius: 3 }, { case: 'setLights', value: { radiusM: 3 } }],
    ['intensity', { lightIntensity: 0 }, { case: 'setLights', value: { intensity: 0 } }],
    ['seed', { lightSeed: 9 }, { case: 'setLights', value: { seed: 9 } }],
    ['animate', { lightAnimate: false }, { case: 'setLights', value: { animate: false } }],
    ['speed', { lightSpeed: 2 }, { case: 'setLights', value: { speed: 2 } }],
    ['ambient', { ambient: 0 }, { case: 'setLights', value: { ambient: 0 } }],
    ['scene lights', { sceneLights: false }, { case: 'setLights', value: { sceneLights: false } }],
    ['box', { lightBox: kBounds }, { case: 'setLights', value: { box: kBounds } }],
    ['grid', { gridY: 5 }, { case: 'setGrid', value: { grid: { x: 16, y: 5, z: 24 } } }],
    ['exposure', { exposure: 2 }, { case: 'setExposure', value: { exposure: 2 } }],
    [
      'tone map',
      { toneMap: ToneMap.CLAMP },
      { case: 'setExposure', value: { toneMap: ToneMap.CLAMP } },
    ],
    ['quality', { quality: 5 }, { case: 'setEncoding', value: { quality: 5 } }],
    [
      'chroma',
      { chroma: Chroma.CHROMA_444 },
      { case: 'setEncoding', value: { chroma: Chroma.CHROMA_444 } },
    ],
    [
      'toon ramp',
      { toonCompute: [{ x: 0, y: 1, slope: 2 }] },
      { case: 'setToon', value: { compute: { points: [{ x: 0, y: 1, slope: 2 }] } } },
    ],
  ])('Change of %s_IsOneCommandWithNothingElse', (_, change, command) => {
    expect(commandsFor(change)).toEqual([command]);
  });

  it('BoxTakenAway_IsClearBox', () => {
    const boxed = { ...base, lightBox: kBounds };
    expect(settingCommands(boxed, base)).toEqual([
      { case: 'setLights', value: { clearBox: true } },
    ]);
  });

  it('EqualRampsInOtherArrays_AreNoChange', () => {
    expect(commandsFor({ toonFragment: [...base.toonFragment] })).toEqual([]);
  });

  it('ChangesOfManyKinds_KeepTheirOwnCommands', () => {
    const commands = settingCommands(base, { ...base, lights: 1, quality: 1, gridX: 1 });
    expect(commands.map((command) => command.case)).toEqual([
      'setLights',
      'setGrid',
      'setEncoding',
    ]);
  });
});

describe('cameraCommand', () => {
  const { eye, target, up } = base;

  it('SamePose_NoCommand', () => {
    expect(cameraCommand(base, { ...base, lights: 3 } as Settings)).toBeNull();
  });

  it('NewPose_LeavesTheProjectionOut', () => {
    const moved = { x: 1, y: 2, z: 3 };
    expect(cameraCommand(base, { ...base, eye: moved })).toEqual({
      case: 'setCamera',
      value: { eye: moved, target, up },
    });
  });

  it('NewAngle_IsSent', () => {
    expect(cameraCommand(base, { ...base, fovDeg: 60 })).toEqual({
      case: 'setCamera',
      value: { eye, target, up, fovDeg: 60 },
    });
  });

  it('Orthographic_SendsItsHeightAndNoAngle', () => {
    const flat = { ...base, orthographic: true, halfHeight: 4 };
    expect(cameraCommand(base, flat)).toEqual({
      case: 'setCamera',
      value: { eye, target, up, halfHeightM: 4 },
    });
    expect(cameraCommand(flat, { ...flat, fovDeg: 99 })).toBeNull();
  });
});
