// What a viewer can ask for, as one immutable value, and its way from the protocol.

import { equal, vec, type Vec } from '../core/vec3';
import {
  CompareShow,
  Renderer,
  type BloomKind,
  type Codec,
  type EnvironmentLight,
  type Refine,
  type Repeat,
  type ToonRamp,
  type Transparency,
  type Vec3,
  type ViewState,
} from '../gen/froxel/v1/common_pb';
import type { Field } from './field';
import type { PlacedLights } from './placed_lights';
import { kRows, valueAt, type Row } from './setting_table';

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

/**
 * Those of the table's settings that code names. All the others are held beside them, each under
 * its row's key: see valueOf.
 */
interface TableSettings {
  readonly renderer: Renderer;
  readonly lights: number;
  readonly lightRadius: number;
  readonly animate: boolean;
  readonly animationPlaying: boolean;
  readonly animationSpeed: number; // below 0: backwards
  readonly animationRepeat: Repeat;
  readonly environment: EnvironmentLight;
  readonly environmentBackground: boolean;
  readonly exposure: number;
  readonly bloom: BloomKind;
  readonly transparency: Transparency;
  readonly fogDensity: number; // 0: none
  readonly shadowLights: number; // 0: none
  readonly quality: number;
  readonly codec: Codec;
  readonly refine: Refine;
}

export interface Settings extends TableSettings {
  readonly eye: Vec;
  readonly target: Vec;
  readonly up: Vec;
  readonly fovDeg: number; // full vertical angle; perspective only
  readonly halfHeight: number; // metres; orthographic only
  readonly orthographic: boolean;
  readonly lensShiftX: number; // of the picture's middle off the view axis, in half pictures
  readonly lensShiftY: number;
  readonly lightBox: Bounds | null; // null: the scene's bounds
  readonly placedLights: PlacedLights;
  readonly lightTime: number | null; // seconds where the lights' clock stands; null: it runs
  readonly animation: number; // of the scene's, from 1; 0: none
  readonly animationTime: number | null; // seconds of it where it is paused; null: it plays
  readonly materialVariant: number; // of the scene's, from 1; 0: none
  readonly followedCamera: string; // of the scene's, which moves; empty: none
  readonly gridAutomatic: boolean;
  readonly gridX: number; // the size given by hand, used while not automatic
  readonly gridY: number;
  readonly gridZ: number;
  readonly debugFrozen: boolean; // the cluster grid shown is that of a camera kept
  readonly toonFragment: Ramp;
  readonly toonCompute: Ramp;
  readonly width: number;
  readonly height: number;
  readonly compare: string; // what the right side of a comparison has otherwise (comparison.ts); empty: there is none
  readonly compareSplit: number; // where its divider is, as a share of the width
  readonly compareHeatMap: boolean; // shows the difference in place of both sides
}

interface Values {
  readonly number: number;
  readonly boolean: boolean;
  readonly choice: number;
  readonly color: Vec;
}

/** What a field of a kind can be. */
export type ValueOf<F extends Field> = Values[F['kind']];
export type Value = ValueOf<Field>;

export const valueOf = <F extends Field>(settings: Settings, field: F): ValueOf<F> =>
  settings[field.key as keyof Settings] as ValueOf<F>;

export const sameValue = (a: Value, b: Value): boolean =>
  typeof a === 'object' && typeof b === 'object' ? equal(a, b) : a === b;

/** The part of the settings that SetCamera carries. */
export type CameraSettings = Pick<
  Settings,
  'eye' | 'target' | 'up' | 'fovDeg' | 'halfHeight' | 'orthographic' | 'lensShiftX' | 'lensShiftY'
>;

/** Where it stands, and which way it looks. */
export type CameraPose = Pick<CameraSettings, 'eye' | 'target' | 'up'>;

export function cameraOf(settings: Settings): CameraSettings {
  const { eye, target, up, fovDeg, halfHeight, orthographic, lensShiftX, lensShiftY } = settings;
  return { eye, target, up, fovDeg, halfHeight, orthographic, lensShiftX, lensShiftY };
}

export const toVec = (v: Vec3 | undefined): Vec => vec(v?.x ?? 0, v?.y ?? 0, v?.z ?? 0);
const toRamp = (ramp: ToonRamp | undefined): Ramp =>
  (ramp?.points ?? []).map(({ x, y, slope }) => ({ x, y, slope }));

/** A row's value in a state; of a server that does not know it, what is absent on the wire. */
function stateValue(state: ViewState, row: Row): Value {
  const value = valueAt(state, row.inState);
  if (row.kind === 'boolean') return value === true;
  if (row.kind === 'color') return toVec(value as Vec3 | undefined);
  return typeof value === 'number' ? value : 0;
}

const tableSettings = (state: ViewState): TableSettings =>
  // The tests see to it that the rows have all those keys.
  Object.fromEntries(kRows.map((row) => [row.key, stateValue(state, row)])) as unknown as TableSettings;

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
    ...tableSettings(state),
    eye: toVec(state.eye),
    target: toVec(state.target),
    up: toVec(state.up),
    fovDeg: state.fovDeg,
    halfHeight: state.halfHeightM,
    orthographic: state.orthographic,
    lensShiftX: state.lensShift?.x ?? 0,
    lensShiftY: state.lensShift?.y ?? 0,
    lightBox: box && sceneBounds && sameBounds(box, sceneBounds) ? null : box,
    placedLights,
    lightTime: state.lightTimeS ?? null,
    animation: state.animation,
    animationTime: state.animationTimeS ?? null,
    materialVariant: state.materialVariant,
    followedCamera: state.followedCamera,
    gridAutomatic: state.gridAutomatic,
    gridX: state.grid?.x ?? 0,
    gridY: state.grid?.y ?? 0,
    gridZ: state.grid?.z ?? 0,
    debugFrozen: state.debugFrozen,
    toonFragment: toRamp(state.toonFragment),
    toonCompute: toRamp(state.toonCompute),
    width: state.width,
    height: state.height,
    compare: state.compare,
    compareSplit: state.compareSplit,
    compareHeatMap: state.compareShow === CompareShow.HEAT_MAP,
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
