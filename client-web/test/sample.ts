// A server's first words, for tests.

import { create, type MessageInitShape } from '@bufbuild/protobuf';

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
  ViewStateSchema,
  type ViewState,
} from '../src/gen/froxel/v1/common_pb';
import type { WelcomeSchema } from '../src/gen/froxel/v1/server_pb';
import { settingsOf, type Settings } from '../src/settings';

export const kBounds = { min: { x: -10, y: 0, z: -5 }, max: { x: 10, y: 8, z: 5 } };

const kRamp = [
  { x: 0, y: 0.05, slope: 0 },
  { x: 0.5, y: 0.35, slope: 0 },
  { x: 1, y: 1, slope: 0 },
];

type ViewInit = Omit<MessageInitShape<typeof ViewStateSchema>, '$typeName' | '$unknown'>;

export function viewState(change: ViewInit = {}): ViewState {
  return create(ViewStateSchema, {
    eye: { x: -7, y: 2, z: 0 },
    target: { x: 0, y: 2, z: 0 },
    up: { x: 0, y: 1, z: 0 },
    fovDeg: 45,
    halfHeightM: 1,
    renderer: Renderer.CLUSTERED_DEFERRED,
    lighting: LightingStage.AUTO,
    shading: ShadingModel.PBR,
    gbuffer: { normal: NormalEncoding.OCT16, position: PositionSource.DEPTH },
    lightLoop: LightLoop.AUTO,
    gridAutomatic: true,
    gridLaw: GridLaw.LOGARITHMIC,
    lensShift: { x: 0, y: 0 },
    lightCount: 1000,
    lightRadiusM: 2,
    lightIntensity: 1,
    lightCutoff: 0,
    lightCutoffCompensated: false,
    listCap: 0,
    lightSeed: 1,
    lightAnimate: true,
    lightSpeed: 1,
    lightBox: kBounds,
    ambient: 1,
    sceneLights: true,
    grid: { x: 16, y: 9, z: 24 },
    debugView: DebugView.NONE,
    exposure: 1,
    toneMap: ToneMap.PBR_NEUTRAL,
    toonFragment: { points: kRamp },
    toonCompute: { points: kRamp },
    outlineStrength: 0,
    outlineWidth: 0.003,
    bloom: BloomKind.NONE,
    bloomThreshold: 1,
    bloomKnee: 0.5,
    bloomStrength: 0.25,
    bloomRadius: 0.015,
    antialiasing: Antialiasing.NONE,
    transparency: Transparency.SORTED,
    peelLayers: 4,
    fog: {
      density: 0,
      heightFalloff: 0,
      baseHeight: 0,
      anisotropy: 0,
      albedo: { x: 1, y: 1, z: 1 },
      tile: 16,
      slices: 64,
      halfRate: false,
      noise: false,
    },
    shadowLights: 0,
    shadowSize: 256,
    width: 960,
    height: 540,
    quality: 80,
    chroma: Chroma.CHROMA_420,
    codec: Codec.JPEG,
    videoKbps: 6000,
    adaptive: true,
    targetFps: 0,
    refine: Refine.NONE,
    ...change,
  });
}

export const sampleSettings = (change: Partial<Settings> = {}): Settings => ({
  ...settingsOf(viewState(), kBounds, []),
  ...change,
});

export function welcome(scene = 'hall'): MessageInitShape<typeof WelcomeSchema> {
  return {
    protocolMajor: 1,
    sessionId: 7n,
    serverVersion: '0.1',
    device: 'test device',
    scene: { name: scene, cameras: ['nave', 'gallery'], bounds: kBounds },
    state: viewState(),
    ranges: [{ field: 'lights', min: 0, max: 1_000_000 }],
  };
}
