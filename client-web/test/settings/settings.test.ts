import { describe, expect, it } from 'vitest';

import {
  LightingStage,
  NormalEncoding,
  PositionSource,
  Renderer,
} from '../../src/gen/froxel/v1/common_pb';
import { cameraCommand, settingCommands } from '../../src/settings/setting_commands';
import { settingsOf, type Settings } from '../../src/settings/settings';
import { kBounds, sampleSettings, viewState, type Change } from '../sample';

const base = sampleSettings();
const commandsFor = (change: Change): unknown => settingCommands(base, { ...base, ...change });

describe('settingsOf', () => {
  it('LightTime_OfLightsThatMove_IsNone', () => {
    expect(base.lightTime).toBeNull();
    expect(settingsOf(viewState({ lightTimeS: 0 }), kBounds, []).lightTime).toBe(0);
  });

  it('LightBox_ThatIsTheScenesBounds_IsNone', () => {
    expect(base.lightBox).toBeNull();
    const box = { min: { x: 0, y: 0, z: 0 }, max: { x: 1, y: 1, z: 1 } };
    expect(settingsOf(viewState({ lightBox: box }), kBounds, []).lightBox).toEqual(box);
  });
});

describe('settingCommands', () => {
  it('NoChange_NoCommand', () => {
    expect(commandsFor({})).toEqual([]);
  });

  it.each<[string, Change, unknown]>([
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
    [
      'half of the G-buffer layout',
      { gbufferNormal: NormalEncoding.XY16 },
      {
        case: 'setRenderer',
        value: {
          renderer: Renderer.CLUSTERED_DEFERRED,
          gbuffer: { normal: NormalEncoding.XY16 },
        },
      },
    ],
    [
      'the whole G-buffer layout',
      { gbufferNormal: NormalEncoding.XY16, gbufferPosition: PositionSource.FP16 },
      {
        case: 'setRenderer',
        value: {
          renderer: Renderer.CLUSTERED_DEFERRED,
          gbuffer: { normal: NormalEncoding.XY16, position: PositionSource.FP16 },
        },
      },
    ],
    ['light count', { lights: 0 }, { case: 'setLights', value: { count: 0 } }],
    ['light radius', { lightRadius: 3 }, { case: 'setLights', value: { radiusM: 3 } }],
    ['seed', { seed: 9 }, { case: 'setLights', value: { seed: 9 } }],
    ['animate', { animate: false }, { case: 'setLights', value: { animate: false } }],
    ['box', { lightBox: kBounds }, { case: 'setLights', value: { box: kBounds } }],
    ['lights’ clock', { lightTime: 0 }, { case: 'setLights', value: { timeS: 0 } }],
    [
      'material variant',
      { materialVariant: 2 },
      { case: 'setMaterialVariant', value: { materialVariant: 2 } },
    ],
    ['animation', { animation: 2 }, { case: 'setAnimation', value: { animation: 2 } }],
    [
      'a place of a paused animation',
      { animationTime: 0.5, animationSpeed: 2 },
      { case: 'setAnimation', value: { timeS: 0.5, speed: 2 } },
    ],
    [
      'fog and its colour',
      { fogDensity: 0.1, fogAlbedo: { x: 1, y: 0.5, z: 0 } },
      { case: 'setFog', value: { fog: { density: 0.1, albedo: { x: 1, y: 0.5, z: 0 } } } },
    ],
    ['frozen clusters', { debugFrozen: true }, { case: 'setDebugView', value: { freeze: true } }],
    [
      'grid',
      { gridY: 5, gridAutomatic: false },
      { case: 'setGrid', value: { grid: { x: 16, y: 5, z: 24 } } },
    ],
    [
      'toon ramp',
      { toonCompute: [{ x: 0, y: 1, slope: 2 }] },
      { case: 'setToon', value: { compute: { points: [{ x: 0, y: 1, slope: 2 }] } } },
    ],
  ])('Change of %s_IsOneCommandWithNothingElse', (_, change, command) => {
    expect(commandsFor(change)).toEqual([command]);
  });

  it('EqualColourInAnotherObject_IsNoChange', () => {
    expect(commandsFor({ fogAlbedo: { x: 1, y: 1, z: 1 } })).toEqual([]);
  });

  it('GridByHand_BackToAutomatic_SendsNoSize', () => {
    const byHand = { ...base, gridAutomatic: false, gridX: 3 };
    expect(settingCommands(byHand, base)).toEqual([
      { case: 'setGrid', value: { automatic: true } },
    ]);
  });

  it('AutomaticOff_SendsTheSizeToUse', () => {
    expect(commandsFor({ gridAutomatic: false })).toEqual([
      { case: 'setGrid', value: { grid: { x: 16, y: 9, z: 24 } } },
    ]);
  });

  it('LightsThatGoOn_SetNoClock', () => {
    const stopped = { ...base, animate: false, lightTime: 5 };
    expect(settingCommands(stopped, base)).toEqual([
      { case: 'setLights', value: { animate: true } },
    ]);
  });

  it('AnimationThatGoesOn_IsNotSeeked', () => {
    const paused = { ...base, animation: 1, animationTime: 0.5 };
    const playing = { ...paused, animationPlaying: true };
    expect(settingCommands(paused, playing)).toEqual([
      { case: 'setAnimation', value: { playing: true } },
    ]);
    expect(settingCommands(paused, { ...paused, animation: 2 })).toEqual([
      { case: 'setAnimation', value: { animation: 2, timeS: 0.5 } },
    ]);
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
    const grid = { gridX: 1, gridAutomatic: false };
    const commands = settingCommands(base, { ...base, lights: 1, quality: 1, ...grid });
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

  it('LensShift_IsSentOnlyWhereItChanged', () => {
    expect(cameraCommand(base, { ...base, lensShiftY: 0.5 })).toEqual({
      case: 'setCamera',
      value: { eye, target, up, lensShift: { x: 0, y: 0.5 } },
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
