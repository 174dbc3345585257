import { describe, expect, it } from 'vitest';

import {
  Antialiasing,
  BloomKind,
  Chroma,
  Codec,
  DebugView,
  GridLaw,
  LightingStage,
  LightLoop,
  NormalEncoding,
  PositionSource,
  Refine,
  Renderer,
  ShadingModel,
  ToneMap,
  Transparency,
} from '../src/gen/froxel/v1/common_pb';
import { cameraCommand, settingCommands } from '../src/setting_commands';
import { settingsOf, type Settings } from '../src/settings';
import { kBounds, sampleSettings, viewState } from './sample';

const base = sampleSettings();
const commandsFor = (change: Partial<Settings>): unknown =>
  settingCommands(base, { ...base, ...change });

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
    ['cut-off', { lightCutoff: 0.01 }, { case: 'setLights', value: { cutoff: 0.01 } }],
    [
      'compensation',
      { lightCutoffCompensated: true },
      { case: 'setLights', value: { cutoffCompensated: true } },
    ],
    ['list cap', { listCap: 40 }, { case: 'setLights', value: { listCap: 40 } }],
    ['seed', { lightSeed: 9 }, { case: 'setLights', value: { seed: 9 } }],
    ['animate', { lightAnimate: false }, { case: 'setLights', value: { animate: false } }],
    ['speed', { lightSpeed: 2 }, { case: 'setLights', value: { speed: 2 } }],
    ['ambient', { ambient: 0 }, { case: 'setLights', value: { ambient: 0 } }],
    ['scene lights', { sceneLights: false }, { case: 'setLights', value: { sceneLights: false } }],
    ['box', { lightBox: kBounds }, { case: 'setLights', value: { box: kBounds } }],
    ['fog colour', { fogAlbedo: { x: 1, y: 0.5, z: 0 } }, { case: 'setFog', value: { fog: { albedo: { x: 1, y: 0.5, z: 0 } } } }],
    ['light loop', { lightLoop: LightLoop.LISTS }, { case: 'setLights', value: { lightLoop: 2 } }],
    [
      'debug view',
      { debugView: DebugView.LISTED_LIGHTS },
      { case: 'setDebugView', value: { view: DebugView.LISTED_LIGHTS } },
    ],
    ['scale', { debugScaleMax: 40 }, { case: 'setDebugView', value: { scaleMax: 40 } }],
    ['frozen clusters', { debugFrozen: true }, { case: 'setDebugView', value: { freeze: true } }],
    ['pair counting', { countPairs: true }, { case: 'setLights', value: { countPairs: true } }],
    ['lights’ clock', { lightTime: 0 }, { case: 'setLights', value: { timeS: 0 } }],
    [
      'grid',
      { gridY: 5, gridAutomatic: false },
      { case: 'setGrid', value: { grid: { x: 16, y: 5, z: 24 } } },
    ],
    ['grid law', { gridLaw: GridLaw.LINEAR }, { case: 'setGrid', value: { law: GridLaw.LINEAR } }],
    [
      'shading',
      { shading: ShadingModel.LAMBERT },
      {
        case: 'setRenderer',
        value: { renderer: Renderer.CLUSTERED_DEFERRED, shading: ShadingModel.LAMBERT },
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
      'other half of the G-buffer layout',
      { gbufferPosition: PositionSource.FP16 },
      {
        case: 'setRenderer',
        value: {
          renderer: Renderer.CLUSTERED_DEFERRED,
          gbuffer: { position: PositionSource.FP16 },
        },
      },
    ],
    ['exposure', { exposure: 2 }, { case: 'setExposure', value: { exposure: 2 } }],
    [
      'tone map',
      { toneMap: ToneMap.CLAMP },
      { case: 'setExposure', value: { toneMap: ToneMap.CLAMP } },
    ],
    ['outline', { outlineStrength: 1 }, { case: 'setToon', value: { outlineStrength: 1 } }],
    ['outline width', { outlineWidth: 0.01 }, { case: 'setToon', value: { outlineWidth: 0.01 } }],
    [
      'bloom',
      { bloom: BloomKind.MIP_CHAIN },
      { case: 'setPost', value: { bloom: BloomKind.MIP_CHAIN } },
    ],
    ['threshold', { bloomThreshold: 0 }, { case: 'setPost', value: { bloomThreshold: 0 } }],
    ['knee', { bloomKnee: 0 }, { case: 'setPost', value: { bloomKnee: 0 } }],
    ['strength', { bloomStrength: 1 }, { case: 'setPost', value: { bloomStrength: 1 } }],
    ['spread', { bloomRadius: 0.05 }, { case: 'setPost', value: { bloomRadius: 0.05 } }],
    [
      'antialiasing',
      { antialiasing: Antialiasing.SSAA4 },
      { case: 'setPost', value: { antialiasing: Antialiasing.SSAA4 } },
    ],
    [
      'transparency',
      { transparency: Transparency.PEELED },
      { case: 'setTransparency', value: { transparency: Transparency.PEELED } },
    ],
    ['layers', { peelLayers: 9 }, { case: 'setTransparency', value: { peelLayers: 9 } }],
    ['fog', { fogDensity: 0.1 }, { case: 'setFog', value: { fog: { density: 0.1 } } }],
    ['fog’s falloff', { fogHeightFalloff: 2 }, { case: 'setFog', value: { fog: { heightFalloff: 2 } } }],
    ['fog’s base', { fogBaseHeight: -3 }, { case: 'setFog', value: { fog: { baseHeight: -3 } } }],
    ['fog’s phase', { fogAnisotropy: 0.5 }, { case: 'setFog', value: { fog: { anisotropy: 0.5 } } }],
    ['fog’s tile', { fogTile: 8 }, { case: 'setFog', value: { fog: { tile: 8 } } }],
    ['fog’s slices', { fogSlices: 128 }, { case: 'setFog', value: { fog: { slices: 128 } } }],
    ['fog’s rate', { fogHalfRate: true }, { case: 'setFog', value: { fog: { halfRate: true } } }],
    ['fog’s noise', { fogNoise: true }, { case: 'setFog', value: { fog: { noise: true } } }],
    ['shadows', { shadowLights: 4 }, { case: 'setShadows', value: { lights: 4 } }],
    ['shadow map', { shadowSize: 128 }, { case: 'setShadows', value: { size: 128 } }],
    ['quality', { quality: 5 }, { case: 'setEncoding', value: { quality: 5 } }],
    ['adaptive', { adaptive: false }, { case: 'setDelivery', value: { adaptive: false } }],
    ['target rate', { targetFps: 24 }, { case: 'setDelivery', value: { targetFps: 24 } }],
    ['refine', { refine: Refine.HIGH }, { case: 'setDelivery', value: { refine: Refine.HIGH } }],
    [
      'chroma',
      { chroma: Chroma.CHROMA_444 },
      { case: 'setEncoding', value: { chroma: Chroma.CHROMA_444 } },
    ],
    ['codec', { codec: Codec.VP9 }, { case: 'setEncoding', value: { codec: Codec.VP9 } }],
    ['video rate', { videoKbps: 800 }, { case: 'setEncoding', value: { videoKbps: 800 } }],
    [
      'toon ramp',
      { toonCompute: [{ x: 0, y: 1, slope: 2 }] },
      { case: 'setToon', value: { compute: { points: [{ x: 0, y: 1, slope: 2 }] } } },
    ],
  ])('Change of %s_IsOneCommandWithNothingElse', (_, change, command) => {
    expect(commandsFor(change)).toEqual([command]);
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
    const stopped = { ...base, lightAnimate: false, lightTime: 5 };
    expect(settingCommands(stopped, base)).toEqual([
      { case: 'setLights', value: { animate: true } },
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
