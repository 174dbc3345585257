// The page's state and its pure reducer. Effects (sockets, DOM) live elsewhere and only dispatch.
//
// `settings` is what the viewer wants, `sent` what the server has been told, `confirmed` what it
// said last. The server answers every command with its complete state; an answer is adopted only
// when nothing newer is under way, so that a slider never jumps back to where it was a round trip
// ago. A refusal takes the settings back to the confirmed ones.

import { vec } from '../core/vec3';
import { Refine } from '../gen/froxel/v1/common_pb';
import {
  ErrorCode,
  type FieldRange,
  type FrameDetails,
  type Look,
  type SceneInfo,
  type ServerMessage,
} from '../gen/froxel/v1/server_pb';
import type { Link } from '../protocol/connection';
import { findLight, placedAfter, type PlacedLights } from '../settings/placed_lights';
import { cameraOf, settingsOf, type Bounds, type CameraPose, type Settings } from '../settings/settings';
import { sees } from '../settings/sight';
import { mayControl, roomOf, type Room } from './room';
import type { SizeMode } from './size_policy';

export interface ServerInfo {
  readonly version: string;
  readonly protocolMinor: number;
  readonly offersDepth: boolean;
  readonly device: string;
  readonly scene: SceneInfo | null;
  readonly bounds: Bounds | null;
  readonly ranges: ReadonlyMap<string, FieldRange>;
  readonly initial: Settings; // what a new session begins with on this page
  readonly looks: readonly Look[];
}

export interface Loading {
  readonly stage: string;
  readonly fraction: number;
}

/** A scene that was selected and is not there yet. */
export interface SceneLoading extends Loading {
  readonly scene: string; // its id
}

export interface Notice {
  readonly text: string;
  readonly tone: 'error' | 'info';
  readonly stays?: boolean; // until it is dismissed, or another connection is there
  readonly sentSeq?: bigint; // newest command when one was refused: news until a later one is answered
}

/** Of a PickLight: its seq, and the id that the light is to have. */
export interface Pick {
  readonly seq: bigint;
  readonly id: number;
}

export interface AppState {
  readonly link: Link;
  readonly server: ServerInfo | null;
  readonly loading: Loading | null;
  readonly sceneLoading: SceneLoading | null;
  /** The id of a scene to go over to: the server is to be asked for it, or was. */
  readonly wantedScene: string | null;
  readonly settings: Settings | null;
  readonly sent: Settings | null;
  readonly sentSeq: bigint; // newest command that sets state
  readonly confirmed: Settings | null;
  /** What the address asked for; merged into the state that the server begins with, on the wanted scene if there is one. */
  readonly wanted: Partial<Settings>;
  readonly sizeMode: SizeMode | null; // null: until Welcome tells what the server can do
  readonly notice: Notice | null;
  readonly details: FrameDetails | null; // of the frames from now on
  readonly keeps: boolean; // whether the server keeps this session while the connection is lost
  readonly room: Room | null; // null: a session of one's own
  readonly chosenLight: number | null; // id of the placed light that is being edited
  readonly pick: Pick | null; // a light asked for, and not answered yet
  readonly path: string; // the camera path of the address, as path_file.ts writes it; empty: none
  readonly handles: boolean; // whether placed lights have handles over the picture
}

export type Action =
  | { readonly type: 'link'; readonly link: Link }
  | { readonly type: 'received'; readonly message: ServerMessage }
  | { readonly type: 'edit'; readonly patch: Partial<Settings> }
  | { readonly type: 'choose_light'; readonly id: number | null }
  | { readonly type: 'picking'; readonly pick: Pick }
  | { readonly type: 'path'; readonly path: string }
  | { readonly type: 'show_handles'; readonly visible: boolean }
  | { readonly type: 'size_mode'; readonly mode: SizeMode }
  | { readonly type: 'sent'; readonly seq: bigint; readonly settings: Settings }
  | { readonly type: 'camera_moved'; readonly appliedSeq: bigint; readonly pose: CameraPose }
  | { readonly type: 'want_scene'; readonly scene: string | null }
  | {
      readonly type: 'restored';
      readonly wanted: Partial<Settings>;
      readonly size: SizeMode | null;
      readonly scene?: string | null;
      readonly path?: string | null;
    }
  | ({ readonly type: 'notice' } & Notice)
  | { readonly type: 'dismiss' };

export const kInitialState: AppState = {
  link: { phase: 'connecting' },
  server: null,
  loading: null,
  sceneLoading: null,
  wantedScene: null,
  settings: null,
  sent: null,
  sentSeq: 0n,
  confirmed: null,
  wanted: {},
  sizeMode: null,
  notice: null,
  details: null,
  keeps: false,
  room: null,
  chosenLight: null,
  pick: null,
  path: '',
  handles: true,
};

export function reduce(state: AppState, action: Action): AppState {
  switch (action.type) {
    case 'link':
      return linked(state, action.link);
    case 'received':
      return received(state, action.message);
    case 'edit':
      if (!mayControl(state.room)) return state; // it follows who controls
      return state.settings
        ? { ...state, settings: { ...state.settings, ...action.patch } }
        : { ...state, wanted: { ...state.wanted, ...action.patch } };
    case 'choose_light':
      return { ...state, chosenLight: action.id };
    case 'picking':
      return { ...state, pick: action.pick, sentSeq: action.pick.seq };
    case 'path':
      return { ...state, path: action.path };
    case 'show_handles':
      return { ...state, handles: action.visible };
    case 'size_mode':
      return { ...state, sizeMode: action.mode };
    case 'sent':
      return { ...state, sent: action.settings, sentSeq: action.seq };
    case 'camera_moved':
      return cameraMoved(state, action.appliedSeq, action.pose);
    case 'restored':
      return restored(state, action);
    case 'want_scene':
      return { ...state, wantedScene: action.scene, wanted: {}, path: '' }; // a path is of its scene
    case 'notice':
      return { ...state, notice: { text: action.text, tone: action.tone, stays: action.stays ?? false } };
    case 'dismiss':
      return { ...state, notice: null };
  }
}

function linked(state: AppState, link: Link): AppState {
  // A new connection knows nothing of what the last one was told.
  const forget =
    link.phase === 'live' ? {} : { sent: null, sentSeq: 0n, loading: null, sceneLoading: null, pick: null };
  return { ...state, ...forget, link };
}

/** Steering goes on from there. What was asked for since that frame counts more. */
function cameraMoved(state: AppState, appliedSeq: bigint, pose: CameraPose): AppState {
  const { settings, sent, sentSeq, confirmed } = state;
  if (!settings || settings !== sent || appliedSeq < sentSeq || !confirmed) return state;
  const moved = { ...settings, ...pose };
  return { ...state, settings: moved, sent: moved, confirmed: { ...confirmed, ...pose } };
}

function roomChanged(state: AppState, room: Room): AppState {
  if (mayControl(room)) return { ...state, room };
  // What was changed and not answered yet is no more than a wish now.
  return { ...state, room, settings: state.confirmed, sent: state.confirmed };
}

type Restored = Extract<Action, { type: 'restored' }>;

function restored(before: AppState, { wanted, size, scene, path }: Restored): AppState {
  const state = path == null ? before : { ...before, path };
  const sizeMode = size ?? state.sizeMode;
  if (!mayControl(state.room)) return { ...state, sizeMode };
  const wantedScene = scene && scene !== state.server?.scene?.id ? scene : null;
  // What an address says is about its own scene.
  if (wantedScene !== null) return { ...state, wanted, wantedScene, sizeMode };
  if (!state.settings || !state.server) return { ...state, wanted, wantedScene, sizeMode };
  const { settings, notice } = withWanted(state.settings, wanted, state.server);
  return { ...state, wanted, wantedScene, settings, sizeMode, notice: notice ?? state.notice };
}

/** What an address asks for; its view only where that shows something of the scene. */
function withWanted(
  present: Settings,
  wanted: Partial<Settings>,
  { bounds, initial }: { readonly bounds: Bounds | null; readonly initial: Settings },
): { settings: Settings; notice: Notice | null } {
  const settings = { ...present, ...wanted };
  const moves = wanted.eye !== undefined || wanted.target !== undefined;
  if (!moves || !bounds || sees(settings, settings.width / settings.height, bounds)) {
    return { settings, notice: null };
  }
  const text = 'The view of this address shows nothing of the scene. This is the first view of the scene.';
  return { settings: { ...settings, ...cameraOf(initial) }, notice: { text, tone: 'info' } };
}

function received(state: AppState, message: ServerMessage): AppState {
  const { body } = message;
  switch (body.case) {
    case 'welcome':
      return welcomed(state, body.value);
    case 'state': {
      const answer = body.value;
      if (!answer.state) return state;
      const placed = placedAfter(state.confirmed?.placedLights ?? [], answer.placedLights);
      const confirmed = settingsOf(answer.state, state.server?.bounds ?? null, placed);
      const stale =
        mayControl(state.room) &&
        (state.settings !== state.sent || answer.refSeq < state.sentSeq);
      const isOld = state.notice?.sentSeq !== undefined && answer.refSeq > state.notice.sentSeq;
      const notice = isOld ? null : state.notice;
      const told = { ...state, confirmed, notice, ...picked(state, answer.refSeq, placed) };
      return stale ? told : { ...told, settings: confirmed, sent: confirmed };
    }
    case 'sceneLoading': {
      const { scene, stage, fraction } = body.value;
      return { ...state, sceneLoading: scene === '' ? null : { scene, stage, fraction } };
    }
    case 'sceneChanged':
      return sceneChanged(state, body.value);
    case 'error':
      if (body.value.field === 'scene') {
        // Nothing changed, and what was wanted of that scene is of no use.
        const notice: Notice = { text: body.value.message, tone: 'error' };
        return { ...state, wantedScene: null, wanted: {}, notice };
      }
      if (body.value.code === ErrorCode.TOKEN) return state; // the question for one says it
      if (body.value.refSeq > 0n && body.value.refSeq === state.pick?.seq) {
        // Nothing was wished for in the settings that would have to be taken back.
        if (body.value.field === kPickMissed) return { ...home(state), pick: null };
        return { ...state, pick: null, notice: { text: body.value.message, tone: 'error' } };
      }
      return {
        ...state,
        ...(body.value.refSeq > 0n && { settings: state.confirmed, sent: state.confirmed }),
        notice: { text: body.value.message, tone: 'error', sentSeq: state.sentSeq },
      };
    case 'loading':
      return { ...state, loading: body.value.stage === '' ? null : { stage: body.value.stage, fraction: body.value.fraction } };
    case 'details':
      return { ...state, details: body.value };
    case 'roomState':
      return roomChanged(state, roomOf(body.value));
    case 'draining':
      // A session does not move.
      return { ...state, keeps: false, notice: kGoingDown };
    default:
      return state;
  }
}

/** The field that a server names where no light is near what was picked. */
const kPickMissed = 'x';

/** At the scene's first view. */
function home(state: AppState): AppState {
  const { settings, server } = state;
  return settings && server ? { ...state, settings: { ...settings, ...cameraOf(server.initial) } } : state;
}

/** What the answer to a pick changes: the light is chosen. */
function picked({ pick }: AppState, refSeq: bigint, placed: PlacedLights): Partial<AppState> {
  if (!pick || refSeq < pick.seq) return {};
  return { pick: null, ...(findLight(placed, pick.id) && { chosenLight: pick.id }) };
}

type Welcome = Extract<ServerMessage['body'], { case: 'welcome' }>['value'];

function welcomed(state: AppState, welcome: Welcome): AppState {
  if (!welcome.state) {
    const reason = 'The server sent a Welcome without a state.';
    return { ...state, link: { phase: 'refused', reason, remedy: null } };
  }
  const scene = welcome.scene ?? null;
  const bounds = boundsOf(scene);
  const present = settingsOf(welcome.state, bounds, placedAfter([], welcome.placedLights));
  const initial = withoutLoss(
    welcome.defaults
      ? settingsOf(welcome.defaults, bounds, placedAfter([], welcome.defaultPlacedLights))
      : present,
  );
  const room = welcome.room ? roomOf(welcome.room) : null;
  const server: ServerInfo = {
    version: welcome.serverVersion,
    protocolMinor: welcome.protocolMinor,
    offersDepth: welcome.offersDepth,
    device: welcome.device,
    scene,
    bounds,
    ranges: new Map(welcome.ranges.map((range) => [range.field, range])),
    initial,
    looks: welcome.looks,
  };
  const wantedScene = mayControl(room) ? sceneToReturnTo(state, server) : null;
  const begins = wantedScene === null && mayControl(room);
  const { settings, notice } = begins ? desired(state, server, present) : { settings: present, notice: null };
  return {
    ...state,
    link: { phase: 'live' },
    loading: null,
    // News of the last connection, such as that the server goes down, is old now.
    notice: givenAway(state, welcome) ?? notice ?? (state.notice?.tone === 'info' ? null : state.notice),
    keeps: welcome.resumeToken !== '',
    server,
    settings,
    room,
    sent: present,
    sentSeq: 0n,
    confirmed: present,
    wantedScene,
    wanted: wantedScene === null ? {} : (state.settings ?? state.wanted),
  };
}

/** The scene that the address asks for, or that was shown before the connection broke; null: it is there. */
function sceneToReturnTo({ wantedScene, server: before }: AppState, { scene }: ServerInfo): string | null {
  const wanted = wantedScene ?? before?.scene?.id ?? '';
  return wanted === '' || !scene || scene.id === '' || scene.id === wanted ? null : wanted;
}

type SceneChanged = Extract<ServerMessage['body'], { case: 'sceneChanged' }>['value'];

function sceneChanged(state: AppState, changed: SceneChanged): AppState {
  if (!state.server || !changed.state || !changed.defaults) return state;
  const scene = changed.scene ?? null;
  const bounds = boundsOf(scene);
  const present = settingsOf(changed.state, bounds, placedAfter([], changed.placedLights));
  const initial = withoutLoss(
    settingsOf(changed.defaults, bounds, placedAfter([], changed.defaultPlacedLights)),
  );
  const wanted = scene?.id === state.wantedScene ? state.wanted : {};
  const { settings, notice } = withWanted(present, wanted, { bounds, initial });
  return {
    ...state,
    server: { ...state.server, scene, bounds, initial, looks: changed.looks },
    settings,
    notice, // what was said was about the last scene
    sent: present,
    confirmed: present,
    wantedScene: null,
    wanted: {},
    chosenLight: null,
    pick: null,
  };
}

const kGoingDown: Notice = {
  text: 'The server is shutting down. The view continues on the next server.',
  tone: 'info',
  stays: true,
};

function givenAway({ keeps }: AppState, { resumed }: Welcome): Notice | null {
  if (!keeps || resumed) return null;
  const text = 'Another viewer got the place of this view meanwhile. This is a new view with your settings.';
  return { text, tone: 'info' };
}

/** A server refines without loss only for clients that say that they decode it. */
const withoutLoss = (settings: Settings): Settings =>
  settings.refine === Refine.HIGH ? { ...settings, refine: Refine.LOSSLESS } : settings;

/** What to show after Welcome: as before the connection broke, or else as the address says. */
function desired(state: AppState, server: ServerInfo, present: Settings): ReturnType<typeof withWanted> {
  const before = state.settings;
  if (!before) {
    return withWanted(withoutLoss(present), state.wanted, server);
  }
  const { placedLights, animation, animationTime, materialVariant, followedCamera } = present;
  if (isSameScene(state.server?.scene, server.scene)) {
    const follows = followedCamera !== '' && followedCamera === before.followedCamera;
    return { settings: follows ? { ...before, ...cameraOf(present) } : before, notice: null };
  }
  // Another scene: places of the old one mean nothing in it.
  const places = { placedLights, animation, animationTime, materialVariant, followedCamera };
  return { settings: { ...before, ...cameraOf(present), lightBox: null, ...places }, notice: null };
}

/** By id, where the server has several. */
const isSameScene = (a: SceneInfo | null | undefined, b: SceneInfo | null): boolean =>
  a?.id === b?.id && a?.name === b?.name;

function boundsOf(scene: SceneInfo | null): Bounds | null {
  const { min, max } = scene?.bounds ?? {};
  return min && max ? { min: vec(min.x, min.y, min.z), max: vec(max.x, max.y, max.z) } : null;
}
