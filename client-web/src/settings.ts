// What a viewer can ask for, as one immutable value, and its way from the protocol.

import {
  Renderer,
  type Antialiasing,
  type BloomKind,
  type Chroma,
  type Codec,
  type DebugView,
  type GridLaw,
  type LightingStage,
  type LightLoop,
  type NormalEncoding,
  type PositionSource,
  type Refine,
  type ShadingModel,
  type ToneMap,
  type ToonRamp,
  type Transparency,
  type Vec3,
  type ViewState,
} from './gen/froxel/v1/common_pb';
import type { PlacedLights } from './placed_lights';
import { equal, vec, type Vec } from './vec3';

export interface Bounds {
  readonly min: Vec;
  readonly max: Vec;
}

export interface RampPoint {
  readonly x: number;
  readonly y: number;
  readonly slope: number;
}

export type Ramp = readonly RampPoint[];

export interface Settings {
  readonly eye: Vec;
  readonly target: Vec;
  readonly up: Vec;
  readonly fovDeg: number; // full vertical angle; perspective only
  readonly halfHeight: number; // metres; orthographic only
  readonly orthographic: boolean;
  readonly lensShiftX: number; // of the picture's middle off the view axis, in half pictures
  readonly lensShiftY: number;
  readonly renderer: Renderer;
  readonly lighting: LightingStage;
  readonly shading: ShadingModel;
  readonly gbufferNormal: NormalEncoding;
  readonly gbufferPosition: PositionSource;
  readonly lights: number;
  readonly lightRadius: number;
  readonly lightIntensity: number;
  readonly lightCutoff: number;
  readonly lightCutoffCompensated: boolean;
  readonly lightSeed: number;
  readonly lightAnimate: boolean;
  readonly lightSpeed: number;
  readonly lightBox: Bounds | null; // null: the scene's bounds
  readonly ambient: number;
  readonly sceneLights: boolean;
  readonly placedLights: PlacedLights;
  readonly lightLoop: LightLoop;
  readonly listCap: number; // 0: none
  readonly countPairs: boolean;
  readonly lightTime: number | null; // seconds where the lights' clock stands; null: it runs
  readonly gridAutomatic: boolean;
  readonly gridLaw: GridLaw;
  readonly gridX: number; // the size given by hand, used while not automatic
  readonly gridY: number;
  readonly gridZ: number;
  readonly debugView: DebugView;
  readonly debugScaleMax: number; // of its heat map; 0: the server chooses
  readonly debugFrozen: boolean; // the cluster grid shown is that of a camera kept
  readonly exposure: number;
  readonly toneMap: ToneMap;
  readonly toonFragment: Ramp;
  readonly toonCompute: Ramp;
  readonly outlineStrength: number; // 0: none
  readonly outlineWidth: number; // share of the picture's smaller side
  readonly bloom: BloomKind;
  readonly bloomThreshold: number; // exposed radiance
  readonly bloomKnee: number; // share of the threshold
  readonly bloomStrength: number;
  readonly bloomRadius: number; // share of the picture's smaller side
  readonly antialiasing: Antialiasing;
  readonly transparency: Transparency;
  readonly peelLayers: number; // at most, while peeled
  readonly fogDensity: number; // 1/m; 0: none
  readonly fogHeightFalloff: number; // 1/m; 0: the same at every height
  readonly fogBaseHeight: number; // metres
  readonly fogAnisotropy: number;
  readonly fogAlbedo: Vec; // red, green, blue, 0 to 1
  readonly fogTile: number; // pixels
  readonly fogSlices: number;
  readonly fogHalfRate: boolean;
  readonly fogNoise: boolean;
  readonly shadowLights: number; // lights with shadow maps; 0: none
  readonly shadowSize: number; // pixels of a map's side
  readonly width: number;
  readonly height: number;
  readonly quality: number;
  readonly chroma: Chroma;
  readonly codec: Codec;
  readonly videoKbps: number; // while the codec is a video one
  readonly adaptive: boolean;
  readonly targetFps: number; // 0: none
  readonly refine: Refine;
}

/** The part of the settings that SetCamera carries. */
export type CameraSettings = Pick<
  Settings,
  'eye' | 'target' | 'up' | 'fovDeg' | 'halfHeight' | 'orthographic' | 'lensShiftX' | 'lensShiftY'
>;

export function cameraOf(settings: Settings): CameraSettings {
  const { eye, target, up, fovDeg, halfHeight, orthographic, lensShiftX, lensShiftY } = settings;
  return { eye, target, up, fovDeg, halfHeight, orthographic, lensShiftX, lensShiftY };
}

const toVec = (v: Vec3 | undefined): Vec => vec(v?.x ?? 0, v?.y ?? 0, v?.z ?? 0);
const toRamp = (ramp: ToonRamp | undefined): Ramp =>
  (ramp?.points ?? []).map(({ x, y, slope }) => ({ x, y, slope }));

/** The server's state as settings; a light box that is the scene's bounds becomes null. */
export function settingsOf(
  state: ViewState,
  sceneBounds: Bounds | null,
  placedLights: PlacedLights,
): Settings {
  const box = state.lightBox
    ? { min: toVec(state.lightBox.min), max: toVec(state.lightBox.max) }
    : null;
  return {
    eye: toVec(state.eye),
    target: toVec(state.target),
    up: toVec(state.up),
    fovDeg: state.fovDeg,
    halfHeight: state.halfHeightM,
    orthographic: state.orthographic,
    lensShiftX: state.lensShift?.x ?? 0,
    lensShiftY: state.lensShift?.y ?? 0,
    renderer: state.renderer,
    lighting: state.lighting,
    shading: state.shading,
    gbufferNormal: state.gbuffer?.normal ?? 0,
    gbufferPosition: state.gbuffer?.position ?? 0,
    lights: state.lightCount,
    lightRadius: state.lightRadiusM,
    lightIntensity: state.lightIntensity,
    lightCutoff: state.lightCutoff,
    lightCutoffCompensated: state.lightCutoffCompensated,
    lightSeed: state.lightSeed,
    lightAnimate: state.lightAnimate,
    lightSpeed: state.lightSpeed,
    lightBox: box && sceneBounds && sameBounds(box, sceneBounds) ? null : box,
    ambient: state.ambient,
    sceneLights: state.sceneLights,
    placedLights,
    lightLoop: state.lightLoop,
    listCap: state.listCap,
    countPairs: state.countPairs,
    lightTime: state.lightTimeS ?? null,
    gridAutomatic: state.gridAutomatic,
    gridLaw: state.gridLaw,
    gridX: state.grid?.x ?? 0,
    gridY: state.grid?.y ?? 0,
    gridZ: state.grid?.z ?? 0,
    debugView: state.debugView,
    debugScaleMax: state.debugScaleMax,
    debugFrozen: state.debugFrozen,
    exposure: state.exposure,
    toneMap: state.toneMap,
    toonFragment: toRamp(state.toonFragment),
    toonCompute: toRamp(state.toonCompute),
    outlineStrength: state.outlineStrength,
    outlineWidth: state.outlineWidth,
    bloom: state.bloom,
    bloomThreshold: state.bloomThreshold,
    bloomKnee: state.bloomKnee,
    bloomStrength: state.bloomStrength,
    bloomRadius: state.bloomRadius,
    antialiasing: state.antialiasing,
    transparency: state.transparency,
    peelLayers: state.peelLayers,
    fogDensity: state.fog?.density ?? 0,
    fogHeightFalloff: state.fog?.heightFalloff ?? 0,
    fogBaseHeight: state.fog?.baseHeight ?? 0,
    fogAnisotropy: state.fog?.anisotropy ?? 0,
    fogAlbedo: state.fog?.albedo ? toVec(state.fog.albedo) : vec(1, 1, 1),
    fogTile: state.fog?.tile ?? 16,
    fogSlices: state.fog?.slices ?? 64,
    fogHalfRate: state.fog?.halfRate ?? false,
    fogNoise: state.fog?.noise ?? false,
    shadowLights: state.shadowLights,
    shadowSize: state.shadowSize,
    width: state.width,
    height: state.height,
    quality: state.quality,
    chroma: state.chroma,
    codec: state.codec,
    videoKbps: state.videoKbps,
    adaptive: state.adaptive,
    targetFps: state.targetFps,
    refine: state.refine,
  };
}

/** Whether there is a G-buffer. */
export function isDeferred({ renderer }: Settings): boolean {
  return renderer !== Renderer.NAIVE && renderer !== Renderer.FORWARD_PLUS;
}

export function isToon({ renderer }: Settings): boolean {
  return renderer === Renderer.TOON_FRAGMENT || renderer === Renderer.TOON_COMPUTE;
}

export function sameBounds(a: Bounds | null, b: Bounds | null): boolean {
  return a === b || (a !== null && b !== null && equal(a.min, b.min) && equal(a.max, b.max));
}

export function sameRamp(a: Ramp, b: Ramp): boolean {
  const same = (p: RampPoint, q: RampPoint | undefined): boolean =>
    q !== undefined && p.x === q.x && p.y === q.y && p.slope === q.slope;
  return a.length === b.length && a.every((point, index) => same(point, b[index]));
}
