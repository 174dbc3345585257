// What a viewer can ask for, as one immutable value, and its way from and to the protocol.

import type { MessageInitShape } from '@bufbuild/protobuf';

import type { ClientMessageSchema } from './gen/froxel/v1/client_pb';
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
import { placedChanges, type PlacedLights } from './placed_lights';
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

export type ClientBody = NonNullable<MessageInitShape<typeof ClientMessageSchema>['body']>;

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

function sameProjection(a: CameraSettings, b: CameraSettings): boolean {
  if (a.orthographic !== b.orthographic) return false;
  return a.orthographic ? a.halfHeight === b.halfHeight : a.fovDeg === b.fovDeg;
}

/** The camera command that takes `from` to `to`, if they differ; the projection only if it changed. */
export function cameraCommand(from: CameraSettings, to: CameraSettings): ClientBody | null {
  const samePose = equal(from.eye, to.eye) && equal(from.target, to.target) && equal(from.up, to.up);
  const keepProjection = sameProjection(from, to);
  const keepShift = from.lensShiftX === to.lensShiftX && from.lensShiftY === to.lensShiftY;
  if (samePose && keepProjection && keepShift) return null;
  const projection = to.orthographic ? { halfHeightM: to.halfHeight } : { fovDeg: to.fovDeg };
  return {
    case: 'setCamera',
    value: {
      eye: to.eye,
      target: to.target,
      up: to.up,
      ...(keepProjection ? {} : projection),
      ...(keepShift ? {} : { lensShift: { x: to.lensShiftX, y: to.lensShiftY } }),
    },
  };
}

/** The fewest commands that take `from` to `to`, without the camera's. */
export function settingCommands(from: Settings, to: Settings): ClientBody[] {
  const commands: ClientBody[] = [];
  const changed = (...keys: (keyof Settings)[]): boolean =>
    keys.some((key) => from[key] !== to[key]);

  if (changed('width', 'height')) {
    commands.push({ case: 'setSize', value: { width: to.width, height: to.height } });
  }
  if (changed('renderer', 'lighting', 'shading', 'gbufferNormal', 'gbufferPosition')) {
    commands.push({ case: 'setRenderer', value: rendererChanges(from, to) });
  }
  const lights = lightChanges(from, to);
  if (Object.keys(lights).length > 0) commands.push({ case: 'setLights', value: lights });
  for (const value of placedChanges(from.placedLights, to.placedLights)) {
    commands.push({ case: 'setPlacedLights', value });
  }
  const grid = gridChanges(from, to);
  if (Object.keys(grid).length > 0) commands.push({ case: 'setGrid', value: grid });
  if (changed('debugView', 'debugScaleMax', 'debugFrozen')) {
    commands.push({
      case: 'setDebugView',
      value: {
        ...(changed('debugView') && { view: to.debugView }),
        ...(changed('debugScaleMax') && { scaleMax: to.debugScaleMax }),
        ...(changed('debugFrozen') && { freeze: to.debugFrozen }),
      },
    });
  }
  if (changed('exposure', 'toneMap')) {
    commands.push({
      case: 'setExposure',
      value: {
        ...(changed('exposure') && { exposure: to.exposure }),
        ...(changed('toneMap') && { toneMap: to.toneMap }),
      },
    });
  }
  const toon = toonChanges(from, to);
  if (Object.keys(toon).length > 0) commands.push({ case: 'setToon', value: toon });
  const post = postChanges(from, to);
  if (Object.keys(post).length > 0) commands.push({ case: 'setPost', value: post });
  const transparency = transparencyChanges(from, to);
  if (Object.keys(transparency).length > 0) {
    commands.push({ case: 'setTransparency', value: transparency });
  }
  const fog = fogChanges(from, to);
  if (Object.keys(fog).length > 0) commands.push({ case: 'setFog', value: { fog } });
  if (changed('shadowLights', 'shadowSize')) {
    commands.push({
      case: 'setShadows',
      value: {
        ...(changed('shadowLights') && { lights: to.shadowLights }),
        ...(changed('shadowSize') && { size: to.shadowSize }),
      },
    });
  }
  if (changed('quality', 'chroma', 'codec', 'videoKbps')) {
    commands.push({
      case: 'setEncoding',
      value: {
        ...(changed('quality') && { quality: to.quality }),
        ...(changed('chroma') && { chroma: to.chroma }),
        ...(changed('codec') && { codec: to.codec }),
        ...(changed('videoKbps') && { videoKbps: to.videoKbps }),
      },
    });
  }
  if (changed('adaptive', 'targetFps', 'refine')) {
    commands.push({
      case: 'setDelivery',
      value: {
        ...(changed('adaptive') && { adaptive: to.adaptive }),
        ...(changed('targetFps') && { targetFps: to.targetFps }),
        ...(changed('refine') && { refine: to.refine }),
      },
    });
  }
  return commands;
}

type RendererValue = Extract<ClientBody, { case: 'setRenderer' }>['value'];

function rendererChanges(from: Settings, to: Settings): RendererValue {
  const gbuffer = {
    ...(from.gbufferNormal !== to.gbufferNormal && { normal: to.gbufferNormal }),
    ...(from.gbufferPosition !== to.gbufferPosition && { position: to.gbufferPosition }),
  };
  return {
    renderer: to.renderer,
    ...(from.lighting !== to.lighting && { lighting: to.lighting }),
    ...(from.shading !== to.shading && { shading: to.shading }),
    ...(Object.keys(gbuffer).length > 0 && { gbuffer }),
  };
}

type ToonValue = Extract<ClientBody, { case: 'setToon' }>['value'];

function toonChanges(from: Settings, to: Settings): ToonValue {
  const fragment = !sameRamp(from.toonFragment, to.toonFragment);
  const compute = !sameRamp(from.toonCompute, to.toonCompute);
  return {
    ...(fragment && { fragment: { points: [...to.toonFragment] } }),
    ...(compute && { compute: { points: [...to.toonCompute] } }),
    ...(from.outlineStrength !== to.outlineStrength && { outlineStrength: to.outlineStrength }),
    ...(from.outlineWidth !== to.outlineWidth && { outlineWidth: to.outlineWidth }),
  };
}

type PostValue = Extract<ClientBody, { case: 'setPost' }>['value'];

function postChanges(from: Settings, to: Settings): PostValue {
  return {
    ...(from.bloom !== to.bloom && { bloom: to.bloom }),
    ...(from.bloomThreshold !== to.bloomThreshold && { bloomThreshold: to.bloomThreshold }),
    ...(from.bloomKnee !== to.bloomKnee && { bloomKnee: to.bloomKnee }),
    ...(from.bloomStrength !== to.bloomStrength && { bloomStrength: to.bloomStrength }),
    ...(from.bloomRadius !== to.bloomRadius && { bloomRadius: to.bloomRadius }),
    ...(from.antialiasing !== to.antialiasing && { antialiasing: to.antialiasing }),
  };
}

type TransparencyValue = Extract<ClientBody, { case: 'setTransparency' }>['value'];

function transparencyChanges(from: Settings, to: Settings): TransparencyValue {
  return {
    ...(from.transparency !== to.transparency && { transparency: to.transparency }),
    ...(from.peelLayers !== to.peelLayers && { peelLayers: to.peelLayers }),
  };
}

type FogValue = NonNullable<Extract<ClientBody, { case: 'setFog' }>['value']['fog']>;

function fogChanges(from: Settings, to: Settings): FogValue {
  return {
    ...(from.fogDensity !== to.fogDensity && { density: to.fogDensity }),
    ...(from.fogHeightFalloff !== to.fogHeightFalloff && { heightFalloff: to.fogHeightFalloff }),
    ...(from.fogBaseHeight !== to.fogBaseHeight && { baseHeight: to.fogBaseHeight }),
    ...(from.fogAnisotropy !== to.fogAnisotropy && { anisotropy: to.fogAnisotropy }),
    ...(from.fogTile !== to.fogTile && { tile: to.fogTile }),
    ...(from.fogSlices !== to.fogSlices && { slices: to.fogSlices }),
    ...(from.fogHalfRate !== to.fogHalfRate && { halfRate: to.fogHalfRate }),
    ...(from.fogNoise !== to.fogNoise && { noise: to.fogNoise }),
  };
}

type GridValue = Extract<ClientBody, { case: 'setGrid' }>['value'];

/** A size turns automatic off, so that the two never come together. */
function gridChanges(from: Settings, to: Settings): GridValue {
  const sized = from.gridX !== to.gridX || from.gridY !== to.gridY || from.gridZ !== to.gridZ;
  const switched = from.gridAutomatic !== to.gridAutomatic;
  return {
    ...(to.gridAutomatic && switched && { automatic: true }),
    ...(!to.gridAutomatic &&
      (sized || switched) && { grid: { x: to.gridX, y: to.gridY, z: to.gridZ } }),
    ...(from.gridLaw !== to.gridLaw && { law: to.gridLaw }),
  };
}

type LightsValue = Extract<ClientBody, { case: 'setLights' }>['value'];

function lightChanges(from: Settings, to: Settings): LightsValue {
  return {
    ...(from.lights !== to.lights && { count: to.lights }),
    ...(from.lightRadius !== to.lightRadius && { radiusM: to.lightRadius }),
    ...(from.lightIntensity !== to.lightIntensity && { intensity: to.lightIntensity }),
    ...(from.lightCutoff !== to.lightCutoff && { cutoff: to.lightCutoff }),
    ...(from.lightCutoffCompensated !== to.lightCutoffCompensated && {
      cutoffCompensated: to.lightCutoffCompensated,
    }),
    ...(from.listCap !== to.listCap && { listCap: to.listCap }),
    ...(from.lightSeed !== to.lightSeed && { seed: to.lightSeed }),
    ...(from.lightAnimate !== to.lightAnimate && { animate: to.lightAnimate }),
    ...(from.lightSpeed !== to.lightSpeed && { speed: to.lightSpeed }),
    ...(from.ambient !== to.ambient && { ambient: to.ambient }),
    ...(from.sceneLights !== to.sceneLights && { sceneLights: to.sceneLights }),
    ...(from.lightLoop !== to.lightLoop && { lightLoop: to.lightLoop }),
    ...(from.countPairs !== to.countPairs && { countPairs: to.countPairs }),
    ...(to.lightTime !== null && from.lightTime !== to.lightTime && { timeS: to.lightTime }),
    ...(!sameBounds(from.lightBox, to.lightBox) &&
      (to.lightBox ? { box: to.lightBox } : { clearBox: true })),
  };
}
