// A server's first words, for tests.

import { create, type MessageInitShape } from '@bufbuild/protobuf';

import {
  Codec,
  Renderer,
  ViewStateSchema,
  type ViewState,
} from '../src/gen/froxel/v1/common_pb';
import type { WelcomeSchema } from '../src/gen/froxel/v1/server_pb';
import { choicesOf } from '../src/protocol/schema_names';
import { kRows, putAt, type Parts, type Row } from '../src/settings/setting_table';
import { settingsOf, type Settings, type Value } from '../src/settings/settings';

export const kBounds = { min: { x: -10, y: 0, z: -5 }, max: { x: 10, y: 8, z: 5 } };

const kRamp = [
  { x: 0, y: 0.05, slope: 0 },
  { x: 0.5, y: 0.35, slope: 0 },
  { x: 1, y: 1, slope: 0 },
];

type ViewInit = Omit<MessageInitShape<typeof ViewStateSchema>, '$typeName' | '$unknown'>;

function plain(row: Row): Value {
  if (row.kind === 'boolean') return false;
  if (row.kind === 'color') return { x: 1, y: 1, z: 1 };
  return row.kind === 'choice' ? (choicesOf(row.schema)[0]?.value ?? 0) : 0;
}

function plainSettings(): Parts {
  const parts: Parts = {};
  for (const row of kRows) putAt(parts, row.inState, plain(row));
  return parts;
}

export function viewState(change: ViewInit = {}): ViewState {
  return create(ViewStateSchema, {
    ...plainSettings(),
    eye: { x: -7, y: 2, z: 0 },
    target: { x: 0, y: 2, z: 0 },
    up: { x: 0, y: 1, z: 0 },
    fovDeg: 45,
    halfHeightM: 1,
    lensShift: { x: 0, y: 0 },
    renderer: Renderer.CLUSTERED_DEFERRED,
    lightCount: 1000,
    lightRadiusM: 2,
    lightSeed: 1,
    lightAnimate: true,
    lightBox: kBounds,
    gridAutomatic: true,
    grid: { x: 16, y: 9, z: 24 },
    exposure: 1,
    toonFragment: { points: kRamp },
    toonCompute: { points: kRamp },
    width: 960,
    height: 540,
    quality: 80,
    codec: Codec.JPEG,
    ...change,
  });
}

/** Settings of the table that code does not name are there too. */
export type Change = Partial<Settings> & Readonly<Record<string, unknown>>;

export const sampleSettings = (change: Change = {}): Settings => ({
  ...settingsOf(viewState(), kBounds, []),
  ...change,
});

export function welcome(scene = 'hall', id = ''): MessageInitShape<typeof WelcomeSchema> {
  return {
    protocolMajor: 1,
    sessionId: 7n,
    serverVersion: '0.1',
    device: 'test device',
    scene: { name: scene, id, cameras: ['nave', 'gallery'], bounds: kBounds },
    state: viewState(),
    ranges: [{ field: 'lights', min: 0, max: 1_000_000 }],
  };
}
