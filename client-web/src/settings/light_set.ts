// Placed lights from files and addresses: the protocol's own message as JSON. Fetched when one is read or saved.

import { create, fromJsonString, toJsonString } from '@bufbuild/protobuf';

import { PlacedLightsSchema } from '../gen/froxel/v1/common_pb';
import { messageOf, placedAfter, type PlacedLights } from './placed_lights';

export function lightSetText(lights: PlacedLights): string {
  const message = create(PlacedLightsSchema, { lights: lights.map(messageOf) });
  return toJsonString(PlacedLightsSchema, message, { prettySpaces: 2 });
}

/** The server judges its values. Throws where it is none. */
export function lightSetOf(text: string): PlacedLights {
  const set = fromJsonString(PlacedLightsSchema, text);
  if (set.clear || set.remove.length > 0) throw new Error('a light set may contain only lights');
  const ids = new Set<number>();
  for (const { id, position } of set.lights) {
    if (id === 0 || ids.has(id)) throw new Error(`light id ${id} is 0 or appears twice`);
    if (!position) throw new Error(`light ${id} has no position`);
    ids.add(id);
  }
  return placedAfter([], set);
}
