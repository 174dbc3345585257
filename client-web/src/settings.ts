// What a viewer can ask for, as one immutable value, and its way from and to the protocol.

import type { MessageInitShape } from '@bufbuild/protobuf';

import type { ClientMessageSchema } from './gen/froxel/v1/client_pb';
import {
  Renderer,
  type Chroma,
  type LightingStage,
  type ToneMap,
  type ToonRamp,
  type Vec3,
  type ViewState,
} from './gen/froxel/v1/common_pb';
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
  readonly renderer: Renderer;
  readonly lighting: LightingStage;
  readonly lights: number;
  readonly lightRadius: number;
  readonly lightIntensity: number;
  readonly lightSeed: number;
  readonly lightAnimate: boolean;
  readonly lightSpeed: number;
  readonly lightBox: Bounds | null; // null: the scene's bounds
  readonly ambient: number;
  readonly sceneLights: boolean;
  readonly gridX: number;
  readonly gridY: number;
  readonly gridZ: number;
  readonly exposure: number;
  readonly toneMap: ToneMap;
  readonly toonFragment: Ramp;
  readonly toonCompute: Ramp;
  readonly width: number;
  readonly height: number;
  readonly quality: number;
  readonly chroma: Chroma;
}

/** The part of the settings that SetCamera carries. */
export type CameraSettings = Pick<
  Settings,
  'eye' | 'target' | 'up' | 'fovDeg' | 'halfHeight' | 'orthographic'
>;

export function cameraOf(settings: Settings): CameraSettings {
  const { eye, target, up, fovDeg, halfHeight, orthographic } = settings;
  return { eye, target, up, fovDeg, halfHeight, orthographic };
}

export type ClientBody = NonNullable<MessageInitShape<typeof ClientMessageSchema>['body']>;

const toVec = (v: Vec3 | undefined): Vec => vec(v?.x ?? 0, v?.y ?? 0, v?.z ?? 0);
const toRamp = (ramp: ToonRamp | undefined): Ramp =>
  (ramp?.points ?? []).map(({ x, y, slope }) => ({ x, y, slope }));

/** The server's state as settings; a light box that is the scene's bounds becomes null. */
export function settingsOf(state: ViewState, sceneBounds: Bounds | null): Settings {
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
    renderer: state.renderer,
    lighting: state.lighting,
    lights: state.lightCount,
    lightRadius: state.lightRadiusM,
    lightIntensity: state.lightIntensity,
    lightSeed: state.lightSeed,
    lightAnimate: state.lightAnimate,
    lightSpeed: state.lightSpeed,
    lightBox: box && sceneBounds && sameBounds(box, sceneBounds) ? null : box,
    ambient: state.ambient,
    sceneLights: state.sceneLights,
    gridX: state.grid?.x ?? 0,
    gridY: state.grid?.y ?? 0,
    gridZ: state.grid?.z ?? 0,
    exposure: state.exposure,
    toneMap: state.toneMap,
    toonFragment: toRamp(state.toonFragment),
    toonCompute: toRamp(state.toonCompute),
    width: state.width,
    height: state.height,
    quality: state.quality,
    chroma: state.chroma,
  };
}

/** Whether the lighting stage matters. */
export function isDeferred({ renderer }: Settings): boolean {
  return renderer !== Renderer.NAIVE && renderer !== Renderer.FORWARD_PLUS;
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
  if (samePose && keepProjection) return null;
  const projection = to.orthographic ? { halfHeightM: to.halfHeight } : { fovDeg: to.fovDeg };
  return {
    case: 'setCamera',
    value: { eye: to.eye, target: to.target, up: to.up, ...(keepProjection ? {} : projection) },
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
  if (changed('renderer', 'lighting')) {
    const stage = changed('lighting') ? { lighting: to.lighting } : {};
    commands.push({ case: 'setRenderer', value: { renderer: to.renderer, ...stage } });
  }
  const lights = lightChanges(from, to);
  if (Object.keys(lights).length > 0) commands.push({ case: 'setLights', value: lights });
  if (changed('gridX', 'gridY', 'gridZ')) {
    const grid = { x: to.gridX, y: to.gridY, z: to.gridZ };
    commands.push({ case: 'setGrid', value: { grid } });
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
  const fragment = !sameRamp(from.toonFragment, to.toonFragment);
  const compute = !sameRamp(from.toonCompute, to.toonCompute);
  if (fragment || compute) {
    commands.push({
      case: 'setToon',
      value: {
        ...(fragment && { fragment: { points: [...to.toonFragment] } }),
        ...(compute && { compute: { points: [...to.toonCompute] } }),
      },
    });
  }
  if (changed('quality', 'chroma')) {
    commands.push({
      case: 'setEncoding',
      value: {
        ...(changed('quality') && { quality: to.quality }),
        ...(changed('chroma') && { chroma: to.chroma }),
      },
    });
  }
  return commands;
}

type LightsValue = Extract<ClientBody, { case: 'setLights' }>['value'];

function lightChanges(from: Settings, to: Settings): LightsValue {
  return {
    ...(from.lights !== to.lights && { count: to.lights }),
    ...(from.lightRadius !== to.lightRadius && { radiusM: to.lightRadius }),
    ...(from.lightIntensity !== to.lightIntensity && { intensity: to.lightIntensity }),
    ...(from.lightSeed !== to.lightSeed && { seed: to.lightSeed }),
    ...(from.lightAnimate !== to.lightAnimate && { animate: to.lightAnimate }),
    ...(from.lightSpeed !== to.lightSpeed && { speed: to.lightSpeed }),
    ...(from.ambient !== to.ambient && { ambient: to.ambient }),
    ...(from.sceneLights !== to.sceneLights && { sceneLights: to.sceneLights }),
    ...(!sameBounds(from.lightBox, to.lightBox) &&
      (to.lightBox ? { box: to.lightBox } : { clearBox: true })),
  };
}
