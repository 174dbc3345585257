// Lights that viewers place: their values, and their way from and to the protocol and files.

import { equal, vec, type Vec } from '../core/vec3';
import {
  LightKind,
  LightKindSchema,
  type PlacedLight as PlacedLightMessage,
  type PlacedLights as PlacedLightsMessage,
} from '../gen/froxel/v1/common_pb';
import { choicesOf } from '../protocol/schema_names';

/** The light that another one stands for, by its index: at most one of them. */
interface Replaced {
  readonly replacesSeeded?: number | undefined;
  readonly replacesScene?: number | undefined;
}

export interface PlacedLight extends Replaced {
  readonly id: number;
  readonly kind: LightKind;
  readonly position: Vec; // metres, world
  readonly direction: Vec; // not of points; of any length but 0
  readonly color: Vec; // linear red, green, blue, 0 to 1
  readonly intensity: number;
  readonly radius: number; // metres, where it ends
  readonly innerConeDeg: number; // half angles; spots only
  readonly outerConeDeg: number;
  readonly widthM: number; // of an area light's rectangle
  readonly heightM: number;
  readonly rollDeg: number;
}

export const kLightKinds = choicesOf(LightKindSchema);

export const kindName = (kind: number): string =>
  kLightKinds.find(({ value }) => value === kind)?.name ?? 'light';

/** Ids ascend. */
export type PlacedLights = readonly PlacedLight[];

/** What the schema says that a new light has. */
export const kNewLight: Omit<PlacedLight, 'id' | 'position'> = {
  kind: LightKind.POINT,
  direction: vec(0, -1, 0),
  color: vec(1, 1, 1),
  intensity: 1,
  radius: 2,
  innerConeDeg: 30,
  outerConeDeg: 45,
  widthM: 1,
  heightM: 1,
  rollDeg: 0,
  replacesSeeded: undefined,
  replacesScene: undefined,
};

/** A message of the server or of a file is not to grow past what a server takes: 64 KiB. */
const kMaxLightsInACommand = 256;

export function sameLight(a: PlacedLight, b: PlacedLight): boolean {
  return (
    a.id === b.id &&
    a.kind === b.kind &&
    equal(a.position, b.position) &&
    equal(a.direction, b.direction) &&
    equal(a.color, b.color) &&
    a.intensity === b.intensity &&
    a.radius === b.radius &&
    a.innerConeDeg === b.innerConeDeg &&
    a.outerConeDeg === b.outerConeDeg &&
    a.widthM === b.widthM &&
    a.heightM === b.heightM &&
    a.rollDeg === b.rollDeg &&
    sameReplaced(a, b)
  );
}

export const findLight = (lights: PlacedLights, id: number | null): PlacedLight | null =>
  lights.find((light) => light.id === id) ?? null;

/** The lights with this one instead of the one that has its id, if any. */
export function withLight(lights: PlacedLights, light: PlacedLight): PlacedLights {
  return [...withoutLight(lights, light.id), light].sort((a, b) => a.id - b.id);
}

export const withoutLight = (lights: PlacedLights, id: number): PlacedLights =>
  lights.filter((light) => light.id !== id);

export const freeId = (lights: PlacedLights): number => (lights.at(-1)?.id ?? 0) + 1;

/** `lights` after a change that the server told, or that a file holds. */
export function placedAfter(
  lights: PlacedLights,
  change: PlacedLightsMessage | undefined,
): PlacedLights {
  if (!change) return lights;
  const byId = new Map(change.clear ? [] : lights.map((light) => [light.id, light]));
  for (const id of change.remove) byId.delete(id);
  for (const light of change.lights) byId.set(light.id, lightOf(light, byId.get(light.id)));
  return [...byId.values()].sort((a, b) => a.id - b.id);
}

const vecOf = (v: Vec | undefined, before: Vec): Vec => (v ? vec(v.x, v.y, v.z) : before);

const replacedBy = ({ replacesSeeded, replacesScene }: Replaced): Replaced => ({
  replacesSeeded,
  replacesScene,
});

/** Fields that are absent are `before`'s, or a new light's. */
function lightOf(told: PlacedLightMessage, before: PlacedLight | undefined): PlacedLight {
  const kept = before ?? { ...kNewLight, position: vec(0, 0, 0) };
  return {
    id: told.id,
    kind: told.kind ?? kept.kind,
    position: vecOf(told.position, kept.position),
    direction: vecOf(told.direction, kept.direction),
    color: vecOf(told.color, kept.color),
    intensity: told.intensity ?? kept.intensity,
    radius: told.radiusM ?? kept.radius,
    innerConeDeg: told.innerConeDeg ?? kept.innerConeDeg,
    outerConeDeg: told.outerConeDeg ?? kept.outerConeDeg,
    widthM: told.widthM ?? kept.widthM,
    heightM: told.heightM ?? kept.heightM,
    rollDeg: told.rollDeg ?? kept.rollDeg,
    ...replacedBy(told.replacesSeeded === undefined && told.replacesScene === undefined ? kept : told),
  };
}

/** As the protocol has it. */
export const messageOf = ({ radius: radiusM, replacesSeeded, replacesScene, ...light }: PlacedLight) => ({
  ...light,
  radiusM,
  ...(replacesSeeded !== undefined && { replacesSeeded }),
  ...(replacesScene !== undefined && { replacesScene }),
});
/** The protocol's JSON of these lights in one line, without what a new light has anyway. */
export const lightSetLine = (lights: PlacedLights): string =>
  JSON.stringify({
    lights: lights.map((light) => {
      const usual: Partial<LightMessage> = messageOf({ ...kNewLight, id: 0, position: vec(0, 0, 0) });
      const all = Object.entries(messageOf(light));
      const isUsual = ([key, value]: [string, unknown]): boolean =>
        key !== 'position' && JSON.stringify(value) === JSON.stringify(usual[key as keyof LightMessage]);
      return Object.fromEntries(all.filter((entry) => !isUsual(entry)));
    }),
  });

export type LightMessage = ReturnType<typeof messageOf>;

export interface PlacedLightsChange {
  clear?: boolean;
  remove?: number[];
  lights?: LightMessage[];
}

/** Whether a change can say so: what a light stands for is not taken back by a field that is absent. */
function continues(light: PlacedLight, now: PlacedLight | undefined): boolean {
  const free = light.replacesSeeded === undefined && light.replacesScene === undefined;
  return now !== undefined && (free || sameReplaced(light, now));
}

const sameReplaced = (a: PlacedLight, b: PlacedLight): boolean =>
  a.replacesSeeded === b.replacesSeeded && a.replacesScene === b.replacesScene;

/** The commands that take `from` to `to`: one, but for large sets. */
export function placedChanges(from: PlacedLights, to: PlacedLights): PlacedLightsChange[] {
  if (from === to) return [];
  const before = new Map(from.map((light) => [light.id, light]));
  const after = new Map(to.map((light) => [light.id, light]));
  const remove = from.filter((light) => !continues(light, after.get(light.id))).map(({ id }) => id);
  const changed = to.filter((light) => {
    const old = before.get(light.id);
    return !old || !sameLight(old, light);
  });
  const lights = changed.map(messageOf);
  const clear = remove.length > 0 && remove.length === from.length;
  const changes: PlacedLightsChange[] = [];
  for (let at = 0; at < lights.length; at += kMaxLightsInACommand) {
    changes.push({ lights: lights.slice(at, at + kMaxLightsInACommand) });
  }
  if (remove.length === 0) return changes;
  const [first = {}, ...rest] = changes;
  return [{ ...(clear ? { clear } : { remove }), ...first }, ...rest];
}
