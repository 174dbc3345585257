// What the panel, the keys and the pointer can do, as actions on the store and the connection.

import { messageOf } from './core/format';
import type { AnimationActions } from './cards/animation_card';
import type { LookActions } from './cards/looks_card';
import type { PictureActions } from './cards/picture_card';
import type { RendererActions } from './cards/renderers_card';
import type { RoomActions } from './cards/room_card';
import { download, fileName } from './core/download';
import { kMissing, Later } from './core/later';
import type { Size } from './core/size';
import { add, length, normalize, scale, sub } from './core/vec3';
import type { Renderer } from './gen/froxel/v1/common_pb';
import type { PanelActions } from './panel/panel';
import type { Picture } from './picture/picture';
import type { Connection } from './protocol/connection';
import type { Recorder } from './protocol/recorder';
import { isUint32, type Field } from './settings/field';
import { patchFor } from './settings/fields';
import {
  findLight,
  freeId,
  kNewLight,
  withLight,
  withoutLight,
  type PlacedLight,
} from './settings/placed_lights';
import { cameraCommand, settingCommands } from './settings/setting_commands';
import { cameraOf, type Settings, type Value } from './settings/settings';
import { centreOf, diagonalOf, fitted, isInside } from './settings/sight';
import { parseAddress, stillAddress } from './state/address';
import { kRenderers, rendererLabel } from './state/renderers';
import { dropLook, isLook, keepLook, lookAddress, offeredLooks, ownLooks, type Look } from './state/looks';
import { mayControl, roomText } from './state/room';
import type { SizeMode } from './state/size_policy';
import type { Store } from './state/store';
import { withinReach, type Pose } from './steering/camera_controller';
import type { InputTarget, View } from './steering/input';

/** Seconds that flying through a scene from end to end takes. */
const kFlightSeconds = 12;
/** How far from its middle a view may go, in diagonals of the scene. */
const kReachDiagonals = 3;
/** The nearest that a zoom comes to its target: the lesser of the two. */
const kClosestM = 0.05;
const kClosestDiagonals = 1e-3;
/** The size of a small still. */
const kSmallStill = '236x133';
/** How far before the eye a new light is put, at most. */
const kAheadM = 4;

export class Commands
  implements
    PanelActions,
    InputTarget,
    RoomActions,
    AnimationActions,
    LookActions,
    PictureActions,
    RendererActions
{
  private readonly lightSet = new Later(
    () => import('./settings/light_set'),
    () => this.refuse(kMissing),
  );
  private readonly scriptFile = new Later(
    () => import('./protocol/script_file'),
    () => this.refuse(kMissing),
  );

  constructor(
    private readonly store: Store,
    private readonly connection: Connection,
    private readonly picture: Picture,
    private readonly recorder: Recorder,
  ) {}

  /** What files are written by is there when it is asked for. */
  prefetch(): void {
    this.scriptFile.ahead();
  }

  edit(patch: Partial<Settings>): void {
    if (!this.allowed()) return;
    this.store.dispatch({ type: 'edit', patch });
  }

  set(field: Field, value: Value): void {
    if (field.kind === 'number' && field.integer && !isUint32(Number(value))) {
      this.refuse(`${field.name} = ${Number(value)}: a whole number from 0 to 4294967295 is needed`);
      return;
    }
    this.edit(patchFor(field, value));
  }

  chooseLight(id: number | null): void {
    this.store.dispatch({ type: 'choose_light', id });
  }

  showHandles(visible: boolean): void {
    this.store.dispatch({ type: 'show_handles', visible });
  }

  /** A little before where the view looks. */
  addLight(): void {
    const { settings, pick } = this.store.state;
    if (!settings || !this.allowed()) return;
    const id = Math.max(freeId(settings.placedLights), (pick?.id ?? 0) + 1);
    const ahead = sub(settings.target, settings.eye);
    const distance = Math.min(kAheadM, length(ahead));
    const position = add(settings.eye, scale(normalize(ahead, ahead), distance));
    this.edit({ placedLights: withLight(settings.placedLights, { ...kNewLight, id, position }) });
    this.chooseLight(id);
  }

  /** Of the moving and the scene's own lights, the one nearest there; from then on it is placed. */
  pickLight({ x, y }: { x: number; y: number }): void {
    const { settings, pick } = this.store.state;
    if (!settings || pick || !this.allowed()) return;
    const id = freeId(settings.placedLights);
    const seq = this.connection.send({ case: 'pickLight', value: { id, x, y } });
    if (seq !== null) this.store.dispatch({ type: 'picking', pick: { seq, id } });
  }

  editLight(id: number, patch: Partial<PlacedLight>): void {
    const { placedLights } = this.store.state.settings ?? { placedLights: [] };
    const light = findLight(placedLights, id);
    if (light) this.edit({ placedLights: withLight(placedLights, { ...light, ...patch }) });
  }

  removeLight(id: number): void {
    const { settings } = this.store.state;
    if (settings) this.edit({ placedLights: withoutLight(settings.placedLights, id) });
  }

  async loadLights(file: Blob & { readonly name: string }): Promise<void> {
    const reader = await this.lightSet.want();
    if (!reader) return;
    try {
      this.edit({ placedLights: reader.lightSetOf(await file.text()) });
    } catch (error) {
      this.refuse(`${file.name} is not a light set: ${messageOf(error)}`);
    }
  }

  async saveLights(): Promise<void> {
    const writer = await this.lightSet.want();
    const { settings } = this.store.state;
    if (!settings || !writer) return;
    const json = new Blob([writer.lightSetText(settings.placedLights)], { type: 'application/json' });
    download(json, fileName('lights.json'));
  }

  setSizeMode(mode: SizeMode): void {
    this.store.dispatch({ type: 'size_mode', mode });
  }

  setSize(width: number, height: number): void {
    if (isUint32(width) && isUint32(height)) this.edit({ width, height });
    else this.refuse(`size = ${width} x ${height}: whole numbers are needed`);
  }

  resetAll(): void {
    const { server } = this.store.state;
    if (!server) return;
    const { width, height } = this.store.state.settings ?? server.initial;
    this.edit({ ...server.initial, width, height });
    if (server.initial.followedCamera !== '') this.home();
  }

  /** The scene's first view. */
  home(): void {
    const { server } = this.store.state;
    if (!server) return;
    const { followedCamera } = server.initial;
    if (followedCamera !== '') this.selectCamera(followedCamera);
    else this.edit(cameraOf(server.initial));
  }

  /** All of the scene, seen from the side that it is seen from now. */
  fit(): void {
    const { server, settings } = this.store.state;
    if (!server?.bounds || !settings) return;
    this.edit(fitted(cameraOf(settings), settings.width / settings.height, server.bounds));
  }

  /** The server's first. */
  looks(): Look[] {
    return [...offeredLooks(this.store.state.server), ...ownLooks()];
  }

  applyLook(look: Look): void {
    const { settings, problems } = parseAddress(look.address);
    this.edit(settings);
    if (problems.length > 0) this.refuse(problems.join('; ')); // kept by another version
  }

  lookPicture(look: Look): string {
    const { server, settings } = this.store.state;
    const over = `${look.address}&size=${kSmallStill}`;
    return settings === null ? '' : `render?${stillAddress(settings, server?.scene?.id ?? '', over)}`;
  }

  newestSeq(): bigint {
    return this.store.state.sentSeq;
  }

  isLookNow(look: Look): boolean {
    const { settings } = this.store.state;
    return settings !== null && isLook(look, settings);
  }

  keepLook(label: string): string | null {
    const { server, settings } = this.store.state;
    if (!server || !settings) return 'there is no view yet whose look could be saved';
    return keepLook(label, lookAddress(server, settings));
  }

  dropLook(label: string): string | null {
    return dropLook(label);
  }

  /** The answer's camera is adopted: the page does not know where the scene's cameras stand. */
  selectCamera(name: string): void {
    if (!this.allowed()) return;
    const seq = this.connection.send({ case: 'selectSceneCamera', value: { name } });
    const { sent } = this.store.state;
    if (seq === null || !sent) return;
    this.store.dispatch({ type: 'sent', seq, settings: sent });
  }

  /** The server's id of a scene. The one that is shown calls off one that is on its way, or else begins anew. */
  selectScene(scene: string): void {
    if (!this.allowed()) return;
    const { server, sceneLoading } = this.store.state;
    if (scene === server?.scene?.id && !sceneLoading) this.home();
    this.store.dispatch({ type: 'want_scene', scene });
  }

  selectCameraAt(index: number): void {
    const name = this.store.state.server?.scene?.cameras[index];
    if (name !== undefined) this.selectCamera(name);
  }

  toggleLights(): void {
    const { settings } = this.store.state;
    if (settings) this.edit({ animate: !settings.animate });
  }

  comparison(): string {
    return this.store.state.settings?.compare ?? '';
  }

  renderer(): Renderer | null {
    return this.store.state.settings?.renderer ?? null;
  }

  chooseRenderer(renderer: Renderer): void {
    if (!this.allowed()) return;
    this.edit({ renderer });
    this.store.dispatch({ type: 'notice', tone: 'info', text: `Drawn by: ${rendererLabel(renderer)}.` });
  }

  nextRenderer(): void {
    const { settings } = this.store.state;
    if (!settings) return;
    const at = kRenderers.findIndex(({ renderer }) => renderer === settings.renderer);
    const next = kRenderers[(at + 1) % kRenderers.length];
    if (next) this.chooseRenderer(next.renderer);
  }

  pictureSize(): Size | null {
    return this.picture.size();
  }

  still(size: Size): { path: string; file: string } {
    return { path: this.pngOf(size, this.store.state.settings), file: fileName('png') };
  }

  /** Path of a still; null: as the server begins. */
  pngOf({ width, height }: Size, settings: Settings | null): string {
    const over = `size=${width}x${height}&format=png`;
    const scene = this.store.state.server?.scene?.id ?? '';
    return `render?${settings === null ? over : stillAddress(settings, scene, over)}`;
  }

  isReadable(): boolean {
    return this.picture.isReadable();
  }

  async saveShown(): Promise<void> {
    const png = await this.picture.png();
    if (!png) {
      this.refuse('There is no picture to save yet.');
      return;
    }
    download(png, fileName('png'));
  }

  /** Starts a recording, or ends it and hands over its file. Whether one is under way now. */
  async toggleRecording(): Promise<boolean> {
    if (this.recorder.recording) {
      const writer = await this.scriptFile.want();
      if (!writer) return true; // nothing is lost
      if (this.recorder.full) this.refuse(`The recording ended after ${this.recorder.most} commands.`);
      const script = writer.scriptText(this.recorder.stop());
      download(new Blob([script], { type: 'application/jsonl' }), fileName('jsonl'));
      return false;
    }
    const { server, settings } = this.store.state;
    if (!server || !settings) {
      this.refuse('There is no session to record yet.');
      return false;
    }
    const camera = cameraCommand(server.initial, settings);
    this.recorder.start([...settingCommands(server.initial, settings), ...(camera ? [camera] : [])]);
    return true;
  }

  requestControl(): void {
    this.connection.send({ case: 'requestControl', value: {} });
  }

  releaseControl(): void {
    this.connection.send({ case: 'releaseControl', value: {} });
  }

  giveControl(memberId: bigint): void {
    this.connection.send({ case: 'giveControl', value: { memberId } });
  }

  view(): View | null {
    const { room, settings } = this.store.state;
    return mayControl(room) ? settings : null;
  }

  refused(): void {
    this.allowed();
  }

  setPose(pose: Pose): void {
    const { server, settings } = this.store.state;
    const bounds = server?.bounds;
    const reach = bounds && { centre: centreOf(bounds), radiusM: kReachDiagonals * this.diagonalM() };
    const { eye, target, up } = reach && settings ? withinReach(settings, pose, reach) : pose;
    this.edit({ eye, target, up });
  }

  setHalfHeight(wanted: number): void {
    const { halfHeight } = this.store.state.settings ?? { halfHeight: wanted };
    const [least, most] = [kClosestDiagonals * this.diagonalM(), kReachDiagonals * this.diagonalM()];
    // Who is beyond may come back.
    this.edit({ halfHeight: Math.max(Math.min(least, halfHeight), Math.min(Math.max(most, halfHeight), wanted)) });
  }

  flySpeed(): number {
    return this.diagonalM() / kFlightSeconds;
  }

  closestM(): number {
    return Math.min(kClosestM, kClosestDiagonals * this.diagonalM());
  }

  /** A scene that begins inside itself is a room, and the eye may have left it. */
  isInRoom(): boolean {
    const { server, settings } = this.store.state;
    if (!server?.bounds || !settings) return false;
    return isInside(server.bounds, server.initial.eye) && isInside(server.bounds, settings.eye);
  }

  /** Of the scene; 1 where it has no extent. */
  private diagonalM(): number {
    const bounds = this.store.state.server?.bounds;
    const diagonal = bounds ? diagonalOf(bounds) : 0;
    return diagonal > 0 ? diagonal : 1;
  }

  /** Who watches a room is told so rather than left to wonder. */
  private allowed(): boolean {
    const { room } = this.store.state;
    if (room === null || mayControl(room)) return true;
    const text = `${roomText(room)} Ask for control to move it.`;
    this.store.dispatch({ type: 'notice', tone: 'info', text });
    return false;
  }

  private refuse(text: string): void {
    this.store.dispatch({ type: 'notice', tone: 'error', text });
  }
}
