// The commands that take one set of settings to another.

import { equal } from '../core/vec3';
import { CompareShow } from '../gen/froxel/v1/common_pb';
import type { ClientBody } from '../protocol/framing';
import { placedChanges } from './placed_lights';
import { kRows, putAt, type CommandName, type Parts } from './setting_table';
import {
  sameBounds,
  sameRamp,
  sameValue,
  valueOf,
  type CameraSettings,
  type Settings,
} from './settings';

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
  if (from.width !== to.width || from.height !== to.height) {
    commands.push({ case: 'setSize', value: { width: to.width, height: to.height } });
  }
  if (from.materialVariant !== to.materialVariant) {
    const value = { materialVariant: to.materialVariant };
    commands.push({ case: 'setMaterialVariant', value });
  }
  for (const name of kCommands) {
    const value = changesOf(name, from, to);
    if (hasAny(value)) commands.push({ case: name, value } as ClientBody);
  }
  const compared = compareChanges(from, to);
  if (hasAny({ ...compared })) commands.push({ case: 'setCompare', value: compared });
  // After the lights that they may stand for.
  for (const value of placedChanges(from.placedLights, to.placedLights)) {
    commands.push({ case: 'setPlacedLights', value });
  }
  return commands;
}

/** Whether no command leads from one to the other. */
export const sameView = (a: Settings, b: Settings): boolean =>
  settingCommands(a, b).length === 0 && cameraCommand(a, b) === null;

const kCommands: readonly CommandName[] = [...new Set(kRows.map(({ command }) => command))];

const hasAny = (parts: Parts): boolean => Object.keys(parts).length > 0;

function changesOf(command: CommandName, from: Settings, to: Settings): Parts {
  const changes: Parts = { ...kOtherChanges[command]?.(from, to) };
  for (const row of kRows) {
    if (row.command !== command) continue;
    const value = valueOf(to, row);
    if (!sameValue(valueOf(from, row), value)) putAt(changes, row.inCommand, value);
  }
  if (command === 'setRenderer' && hasAny(changes)) changes.renderer = to.renderer; // never absent
  return changes;
}

/** What commands hold beside settings of the table. */
const kOtherChanges: Readonly<
  Partial<Record<CommandName, (from: Settings, to: Settings) => object>>
> = {
  setLights: lightChanges,
  setAnimation: animationChanges,
  setGrid: gridChanges,
  setDebugView: debugChanges,
  setToon: toonChanges,
};

type BodyOf<Name extends CommandName> = Extract<ClientBody, { case: Name }>['value'];

function lightChanges(from: Settings, to: Settings): BodyOf<'setLights'> {
  return {
    ...(to.lightTime !== null && from.lightTime !== to.lightTime && { timeS: to.lightTime }),
    ...(!sameBounds(from.lightBox, to.lightBox) &&
      (to.lightBox ? { box: to.lightBox } : { clearBox: true })),
  };
}

/** Another animation begins at its beginning, unless it is told where. */
function animationChanges(from: Settings, to: Settings): BodyOf<'setAnimation'> {
  const another = from.animation !== to.animation;
  const elsewhere = another || from.animationTime !== to.animationTime;
  return {
    ...(another && { animation: to.animation }),
    ...(to.animationTime !== null && elsewhere && { timeS: to.animationTime }),
  };
}

/** A size turns automatic off, so that the two never come together. */
function gridChanges(from: Settings, to: Settings): BodyOf<'setGrid'> {
  const sized = from.gridX !== to.gridX || from.gridY !== to.gridY || from.gridZ !== to.gridZ;
  const switched = from.gridAutomatic !== to.gridAutomatic;
  return {
    ...(to.gridAutomatic && switched && { automatic: true }),
    ...(!to.gridAutomatic &&
      (sized || switched) && { grid: { x: to.gridX, y: to.gridY, z: to.gridZ } }),
  };
}

/** Another right side ends what was shown of the one before. */
function compareChanges(from: Settings, to: Settings): BodyOf<'setCompare'> {
  const another = from.compare !== to.compare;
  const heatMap = to.compare !== '' && to.compareHeatMap;
  const before = from.compare !== '' && from.compareHeatMap;
  return {
    ...(another && { right: to.compare }),
    ...(from.compareSplit !== to.compareSplit && { split: to.compareSplit }),
    ...(heatMap !== before && to.compare !== '' && { show: heatMap ? CompareShow.HEAT_MAP : CompareShow.SIDES }),
  };
}

function debugChanges(from: Settings, to: Settings): BodyOf<'setDebugView'> {
  return from.debugFrozen !== to.debugFrozen ? { freeze: to.debugFrozen } : {};
}

function toonChanges(from: Settings, to: Settings): BodyOf<'setToon'> {
  const fragment = !sameRamp(from.toonFragment, to.toonFragment);
  const compute = !sameRamp(from.toonCompute, to.toonCompute);
  return {
    ...(fragment && { fragment: { points: [...to.toonFragment] } }),
    ...(compute && { compute: { points: [...to.toonCompute] } }),
  };
}
