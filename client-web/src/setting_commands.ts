// The commands that take one set of settings to another.

import type { MessageInitShape } from '@bufbuild/protobuf';

import type { ClientMessageSchema } from './gen/froxel/v1/client_pb';
import { placedChanges } from './placed_lights';
import { sameBounds, sameRamp, type CameraSettings, type Settings } from './settings';
import { equal } from './vec3';

export type ClientBody = NonNullable<MessageInitShape<typeof ClientMessageSchema>['body']>;

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
    ...(!equal(from.fogAlbedo, to.fogAlbedo) && { albedo: to.fogAlbedo }),
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
