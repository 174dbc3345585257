// The composition root: puts the parts together and ties them to the page.

import { actionsOf, camerasOf, looksOf, type Doings } from './actions';
import type { Bring } from './bring';
import type { AnimationCard } from './cards/animation_card';
import { Banner } from './cards/banner';
import type { CompareBar } from './cards/compare_bar';
import { Legend } from './cards/legend';
import type { LooksCard } from './cards/looks_card';
import type { PictureCard } from './cards/picture_card';
import type { RenderersCard } from './cards/renderers_card';
import type { RoomCard } from './cards/room_card';
import type { ScenesCard } from './cards/scenes_card';
import type { SearchCard } from './cards/search_card';
import { TokenPrompt } from './cards/token_prompt';
import { Commands } from './commands';
import { element, make } from './core/dom';
import { entryOf, keyText, type Entry } from './core/entries';
import { wasOpen } from './core/kept';
import { kMissing, Later } from './core/later';
import type { Filming } from './filming';
import { Codec } from './gen/froxel/v1/common_pb';
import type { CompareCard } from './panel/compare_card';
import type { Panel } from './panel/panel';
import { decodableCodecs, kPlainCodec } from './picture/codecs';
import { workerDecoder } from './picture/decoder';
import { Picture } from './picture/picture';
import { Presenter } from './picture/presenter';
import { VideoFallback } from './picture/video_fallback';
import type { LostSync } from './picture/video_track';
import { Connection, type Link } from './protocol/connection';
import { Recorder } from './protocol/recorder';
import { askRefusal } from './protocol/refusal';
import { Resume, tabsChannel, tabShelf } from './protocol/resume';
import { ServerFiles } from './protocol/server_files';
import { sameView } from './settings/setting_commands';
import { toVec, type Settings } from './settings/settings';
import { AddressKeeper } from './state/address_keeper';
import { mayControl, roomFromAddress } from './state/room';
import { keepScene } from './state/scene_sync';
import { SettingsSync } from './state/settings_sync';
import { pictureLabel } from './state/standing';
import { Store } from './state/store';
import { WindowSize } from './state/window_size';
import { LookCosts } from './stats/look_costs';
import { SceneWarnings } from './stats/scene_warnings';
import { Stats } from './stats/stats';
import { StatsCard } from './stats/stats_card';
import { CanvasInput } from './steering/input';
import type { LightHandles } from './steering/light_handles';
import type { Warp } from './warp';

const kPrefetchMs = 1_000; // after the first picture
const kClaimMs = 150; // until another tab has answered
const wantsWarp = new URLSearchParams(location.search).get('reprojection') !== 'off';
const kMinorOfPause = 2; // protocol_minor since which a server knows Pause

const canvas = element('view', HTMLCanvasElement);
const nowMs = (): number => performance.now();
const nextFrame = (action: (nowMs: number) => void): void => void requestAnimationFrame(action);

const wantedRoom = roomFromAddress(location.search);
const roomName = 'name' in wantedRoom ? wantedRoom.name : '';
const resume = new Resume(tabShelf(), roomName, tabsChannel());
const token = new TokenPrompt(tabShelf(), () => connection.open());
const store = new Store();
const stats = new Stats();
const lookCosts = new LookCosts();
const picture = new Picture(canvas);
let codecs: readonly Codec[] = [kPlainCodec]; // until it is known what this browser decodes
const videoFallback = new VideoFallback();
const recorder = new Recorder(nowMs);
const worker = new Worker(new URL('./picture/decode_worker.ts', import.meta.url), { type: 'module' });

const presenter = new Presenter({
  decode: workerDecoder(worker),
  nextFrame,
  nowMs,
  paint: (bitmap, header) => {
    if (header.compared?.layered) {
      warp.here?.restart();
      picture.paintLayers(bitmap, header.scale);
      return;
    }
    picture.paint(bitmap, header.scale);
    if (warp.here) warp.here.setPicture(bitmap, header);
    else bitmap.close();
  },
  acknowledge: (ack) => void connection.send({ case: 'ack', value: ack }),
  painted: (header, decodeMs) => {
    stats.painted(header, decodeMs, nowMs());
    warp.here?.noteLatency(stats.inputToPicture(nowMs()));
    lookCosts.painted(header);
    panel.here?.showGrid(header.grid);
    animationCard.here?.showTime(header.animationTimeS);
    compareBar.here?.painted(header);
    if (header.camera) {
      const { eye, target, up } = header.camera;
      const pose = { eye: toVec(eye), target: toVec(target), up: toVec(up) };
      store.dispatch({ type: 'camera_moved', appliedSeq: header.appliedSeq, pose });
    }
    if (banner.pictureShown(header)) {
      setTimeout(prefetch, kPrefetchMs);
      if (mayControl(store.state.room)) void showDragHint();
    }
  },
  problem: (text) => store.dispatch({ type: 'notice', tone: 'error', text }),
  lostSync,
});

const connection = new Connection(
  new URL('ws', document.baseURI).href.replace(/^http/, 'ws').replace(/#.*$/, ''),
  {
    link: (link) => {
      if (link.phase === 'greeting') {
        presenter.restart();
        warp.here?.restart();
        stats.restart();
      }
      store.dispatch({ type: 'link', link });
    },
    message: (message) => {
      const { body } = message;
      if (body.case === 'welcome') resume.keep(body.value.resumeToken);
      if (body.case === 'error' && body.value.refSeq > 0n) stats.refused();
      if (body.case === 'sceneChanged') warp.here?.restart();
      if (body.case === 'draining') {
        resume.keep(''); // a session does not move
        connection.leave(body.value.deadlineMs, body.value.reconnectUrl);
      }
      const before = store.state.confirmed;
      store.dispatch({ type: 'received', message });
      if (body.case === 'state') stats.answered(body.value.refSeq, !isSame(before, store.state.confirmed));
    },
    frame: (frame, bytes) => {
      stats.received(bytes, nowMs());
      presenter.offer(frame);
    },
    depth: (depth, bytes) => {
      stats.received(bytes, nowMs());
      warp.here?.setDepth(depth);
    },
    sent: (body) => recorder.sent(body),
    tokenWanted: () => token.ask(),
    problem: (text) => store.dispatch({ type: 'notice', tone: 'error', text }),
  },
  {
    openSocket: (url, subprotocol) => new WebSocket(url, subprotocol),
    nowMs,
    wallMs: () => Date.now(),
    random: Math.random,
    askRefusal,
    hello: () => ({ room: roomName, resumeToken: resume.token, token: token.value }),
    after: (delayMs, action) => {
      const timer = setTimeout(action, delayMs);
      return () => clearTimeout(timer);
    },
    get codecs() {
      return codecs;
    },
  },
);

const commands = new Commands(store, connection, picture, recorder);
const handles = new Later(makeHandles, partMissing);
const statsCard = new StatsCard(stats, { droppedHere: () => presenter.droppedCount, cameraText, partMissing });
const panel = new Later(makePanel, partMissing);
const banner = new Banner({
  remedies: {
    connect: () => connection.open(),
    reload: () => location.reload(),
    dismiss: () => store.dispatch({ type: 'dismiss' }),
    stay: () => commands.selectScene(store.state.server?.scene?.id ?? ''),
  },
  lagMs: () => (document.hidden ? 0 : stats.lagMs(nowMs())),
  nowMs,
});
const roomCard = new Later(makeRoom, partMissing);
const animationCard = new Later(makeAnimation, partMissing);
const files = new ServerFiles(() => token.value);
const looksCard = new Later(makeLooks, partMissing);
const scenesCard = new Later(makeScenes, partMissing);
const renderersCard = new Later(makeRenderers, partMissing);
const compareBar = new Later(makeCompareBar, partMissing);
const compareCard = new Later(makeCompareCard, partMissing);
const filming = new Later(makeFilming, partMissing);
const pictureCard = new Later(makePictures, partMissing);
const bring = new Later(makeBring, partMissing);
const searchCard = new Later(makeSearch, partMissing);
let warpMissing = false;
const warp = new Later(makeWarp, () => (warpMissing = true)); // without it the picture shows as it comes
const legend = new Legend();
const sceneWarnings = new SceneWarnings();
const help = element('help', HTMLDialogElement);
const tokenDialog = element('token', HTMLDialogElement);

new WindowSize(store, canvas);
new SettingsSync(store, connection, nextFrame, (settings, atMs) => {
  // Others of a room see the pictures as they come.
  const isAlone = (store.state.room?.memberCount ?? 1) === 1;
  return isAlone && warp.here ? warp.here.askedCamera(settings, atMs) : settings;
});
keepScene(store, connection);
// Who asked their system for less motion begins with what stands still.
const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
const wishes: Partial<Settings> = still ? { animate: false, animationPlaying: false } : {};
const address = new AddressKeeper(store, () => codecs, wishes);
store.listen((state) => {
  panel.here?.show(state);
  banner.show(state);
  roomCard.here?.show(state.room);
  animationCard.here?.show(state);
  handles.here?.show(state);
  compareBar.here?.show(state);
  element('panel', HTMLElement).inert = !mayControl(state.room);
});
store.listen(({ link }, before) => {
  if (link.phase !== 'live' || before.link.phase === 'live') return;
  tellVisibility(true);
  if (warp.here) askForDepth();
});
store.listen(({ settings, room }, before) => {
  if (settings !== before.settings || room !== before.room) warp.here?.cameraMoved();
});
store.listen((state, before) => {
  const [now, then] = [state.settings, before.settings];
  if (state.server === before.server && now?.renderer === then?.renderer && now?.lights === then?.lights) return;
  canvas.setAttribute('aria-label', pictureLabel(state));
});
store.listen(({ settings }, before) => {
  if (!settings || settings === before.settings) return;
  picture.setSplit(settings.compareSplit);
  if (settings.compare !== '') void compareBar.want().then((bar) => bar?.show(store.state));
});
store.listen(({ path }, before) => {
  if (path === before.path) return;
  if (path === '') filming.here?.path.read('');
  else void filming.want().then((made) => made?.path.read(store.state.path));
});
store.listen(({ room }, before) => {
  if (room && !before.room) void roomCard.want().then((card) => card?.show(store.state.room));
});
store.listen(({ sentSeq }, before) => {
  if (sentSeq !== before.sentSeq) stats.asked(sentSeq, nowMs());
});
store.listen(({ details }, before) => {
  if (!details || details === before.details) return;
  statsCard.showDetails(details);
  legend.show(details.legend);
});
store.listen(({ server }, before) => {
  if (!server || server === before.server) return;
  const scene = server.scene?.name ?? 'no scene';
  element('scene-name', HTMLElement).textContent = scene;
  element('tool-scenes', HTMLButtonElement).hidden = !hasScenes();
  const about = `${scene} on ${server.device} · froxel ${server.version}`;
  element('about', HTMLElement).textContent = about;
  sceneWarnings.show(server.scene);
  const id = server.scene?.id ?? '';
  if (id !== before.server?.scene?.id) bring.here?.sceneShown(id);
  if (before.server && id !== (before.server.scene?.id ?? '')) filming.here?.path.sceneShown(store.state.path);
  if (server.scene?.animations.length) void animationCard.want().then((card) => card?.show(store.state));
});

const isSame = (a: Settings | null, b: Settings | null): boolean => a !== null && b !== null && sameView(a, b);

async function makePanel(): Promise<Panel> {
  const [{ Panel }, { fetchWords }] = await Promise.all([
    import('./panel/panel'),
    import('./panel/words'),
    import('./style/panel.css'),
  ]);
  const tell = (open: boolean): void =>
    element('tool-panel', HTMLButtonElement).setAttribute('aria-pressed', String(open));
  const made = new Panel(element('panel', HTMLElement), commands, tell, codecs);
  made.show(store.state);
  void fetchWords().then((words) => {
    made.tell(words);
    searchCard.here?.refresh();
  });
  return made;
}

async function makeLooks(): Promise<LooksCard> {
  const [{ LooksCard }] = await Promise.all([
    import('./cards/looks_card'),
    import('./style/looks.css'),
  ]);
  return new LooksCard(commands, lookCosts, files);
}

async function makeRenderers(): Promise<RenderersCard> {
  const [{ RenderersCard }] = await Promise.all([
    import('./cards/renderers_card'),
    import('./style/renderers.css'),
  ]);
  return new RenderersCard(commands, lookCosts);
}

async function makeCompareBar(): Promise<CompareBar> {
  const [{ CompareBar }] = await Promise.all([
    import('./cards/compare_bar'),
    import('./style/compare.css'),
  ]);
  return new CompareBar(canvas, commands, nowMs);
}

async function makeCompareCard(): Promise<CompareCard> {
  const [{ CompareCard }, { fetchWords }] = await Promise.all([
    import('./panel/compare_card'),
    import('./panel/words'),
    import('./style/compare.css'),
  ]);
  return new CompareCard(commands, await fetchWords());
}

async function makeFilming(): Promise<Filming> {
  const [{ Filming }] = await Promise.all([
    import('./filming'),
    import('./style/path.css'),
  ]);
  return new Filming(store, commands, files, nextFrame);
}

async function makePictures(): Promise<PictureCard> {
  const [{ PictureCard }] = await Promise.all([
    import('./cards/picture_card'),
    import('./style/renderers.css'),
  ]);
  return new PictureCard(commands, files);
}

async function makeRoom(): Promise<RoomCard> {
  const { RoomCard } = await import('./cards/room_card');
  return new RoomCard(commands, {
    enterRoom: (name) => {
      address.write();
      const to = new URL(location.href);
      if (name === '') to.searchParams.delete('room');
      else to.searchParams.set('room', name);
      location.assign(to);
    },
    copyRoomLink: (name) => void address.copyRoom(name),
  });
}

async function makeHandles(): Promise<LightHandles> {
  const { LightHandles } = await import('./steering/light_handles');
  const made = new LightHandles(element('handles', HTMLElement), canvas, commands);
  made.show(store.state);
  return made;
}

async function showDragHint(): Promise<void> {
  const part = await import('./cards/drag_hint').catch(() => null); // nobody waits for a hint
  if (part) new part.DragHint().pictureShown();
}

async function makeAnimation(): Promise<AnimationCard> {
  const { AnimationCard } = await import('./cards/animation_card');
  return new AnimationCard(commands);
}

async function makeWarp(): Promise<Warp> {
  const { makeWarp } = await import('./warp');
  return makeWarp(element('warp', HTMLCanvasElement), {
    wanted: () => (mayControl(store.state.room) ? store.state.settings : null),
    nextFrame,
    nowMs,
    problem: (text) => store.dispatch({ type: 'notice', tone: 'error', text }),
    wishChanged: askForDepth,
  });
}

async function makeScenes(): Promise<ScenesCard> {
  const [{ ScenesCard }] = await Promise.all([
    import('./cards/scenes_card'),
    import('./style/scenes.css'),
  ]);
  const sceneId = (): string => store.state.server?.scene?.id ?? '';
  return new ScenesCard({ selectScene: (id) => commands.selectScene(id), sceneId }, files);
}

async function makeBring(): Promise<Bring> {
  const { Bring } = await import('./bring');
  const made = new Bring({
    files,
    token: () => token.value,
    selectScene: (id) => commands.selectScene(id),
    copyLink: doings.copyLink,
    tell: (text) => store.dispatch({ type: 'notice', tone: 'info', text }),
    partMissing,
  });
  made.sceneShown(store.state.server?.scene?.id ?? '');
  return made;
}

/** Whether the server has more than the one that is shown. */
function hasScenes(): boolean {
  return (store.state.server?.scene?.id ?? '') !== '';
}

async function makeSearch(): Promise<SearchCard> {
  const { SearchCard } = await import('./cards/search_card');
  return new SearchCard(() => [...keyed(), ...(panel.here?.entries() ?? [])]);
}

/** Nobody waits for these when they are wanted, and they open when the server is gone, too. */
function prefetch(): void {
  // Not sooner: a graphics context takes the page some tenths of a second, and an acknowledgement that
  // is as late lets the link seem slow.
  if (wantsWarp && store.state.server?.offersDepth) void warp.want().then(askForDepth);
  handles.ahead();
  panel.ahead();
  looksCard.ahead();
  if (hasScenes()) scenesCard.ahead();
  bring.ahead();
  searchCard.ahead();
  statsCard.prefetch();
  commands.prefetch();
}

/** Its connection has begun, and what is done with depth is there. */
function askForDepth(): void {
  if (!warp.here || !store.state.server?.offersDepth) return;
  connection.send({ case: 'requestDepth', value: { wanted: warp.here.wantsDepth } });
}

/** When a moved camera shows, and why. */
function cameraText(): string {
  if (warp.here) return warp.here.text;
  if (!wantsWarp) return 'late (off)';
  if (store.state.server?.offersDepth === false) return 'late (no depth)';
  return warpMissing ? 'late (no WebGL2)' : 'late';
}

function partMissing(): void {
  store.dispatch({ type: 'notice', tone: 'error', text: kMissing });
}

/** The plain codec stays until the viewer chooses video again: by itself it would swing to and fro. */
function lostSync({ message, broken }: LostSync): void {
  switch (videoFallback.lost(broken, nowMs())) {
    case 'key frame':
      connection.send({ case: 'requestKeyFrame', value: {} });
      break;
    case 'plain codec': {
      const text = `${message}, again and again: back to ${Codec[kPlainCodec]}`;
      store.dispatch({ type: 'notice', tone: 'error', text });
      commands.edit({ codec: kPlainCodec });
      break;
    }
    case 'wait':
  }
}

const doings: Doings = {
  search: () => {
    void searchCard.want().then((search) => {
      search?.toggle();
      void panel.want().then(() => search?.refresh());
    });
  },
  panel: () => void panel.want().then((made) => made?.toggle()),
  looks: () => void looksCard.want().then((card) => card?.toggle()),
  scenes: () => {
    if (hasScenes()) void scenesCard.want().then((card) => card?.toggle());
    else store.dispatch({ type: 'notice', tone: 'info', text: 'This server has one scene.' });
  },
  open: () => void bring.want().then((made) => made?.open()),
  figures: () => statsCard.toggle(),
  renderers: () => void renderersCard.want().then((card) => card?.toggle()),
  compare: () => void compareCard.want().then((card) => card?.toggle()),
  path: () => void filming.want().then((made) => made?.path.toggle()),
  pictures: () => void pictureCard.want().then((card) => card?.toggle()),
  video: () => void filming.want().then((made) => made?.recording.toggle()),
  room: () => void roomCard.want().then((card) => card?.toggle()),
  screenshot: () => (commands.isReadable() ? void commands.saveShown() : doings.pictures()),
  copyLink: () => void address.copy(),
  fullscreen: () => void toggleFullscreen(),
  help: () => (help.open ? help.close() : help.showModal()),
  record: () => {
    void commands.toggleRecording().then((recording) => {
      element('tool-record', HTMLButtonElement).hidden = !recording;
    });
  },
  lights: () => commands.toggleLights(),
  playing: () => animationCard.here?.toggle(),
  nextRenderer: () => {
    renderersCard.here?.noteCost();
    commands.nextRenderer();
  },
  addLight: () => commands.addLight(),
  home: () => commands.home(),
  fit: () => commands.fit(),
  reset: () => commands.resetAll(),
  sceneCamera: (index) => commands.selectCameraAt(index),
  look: (look) => commands.applyLook(look),
};
const actions = actionsOf(doings);
/** The scene's cameras and the looks with them. */
const keyed = (): Entry[] => [
  ...actions,
  ...camerasOf(store.state.server?.scene?.cameras ?? [], doings),
  ...looksOf(commands.looks(), doings),
];

const tools: readonly (readonly [string, () => void])[] = [
  ['tool-search', doings.search],
  ['tool-panel', doings.panel],
  ['tool-scenes', doings.scenes],
  ['tool-open', doings.open],
  ['tool-renderers', doings.renderers],
  ['tool-compare', doings.compare],
  ['tool-looks', doings.looks],
  ['tool-home', doings.home],
  ['tool-screenshot', doings.pictures],
  ['tool-link', doings.copyLink],
  ['tool-room', doings.room],
  ['tool-fullscreen', doings.fullscreen],
  ['tool-help', doings.help],
  ['tool-record', doings.record],
];
for (const [id, run] of tools) {
  const button = element(id, HTMLButtonElement);
  button.addEventListener('click', run);
  // The picture keeps the focus, and with it its keys.
  button.addEventListener('mousedown', (event) => event.preventDefault());
}
for (const entry of actions.filter(({ key }) => key !== '')) {
  const row = make('tr');
  const key = make('td');
  key.append(make('kbd', keyText(entry)));
  row.append(make('th', entry.title), key);
  element('help-keys', HTMLElement).append(row);
}

element('tool-fullscreen', HTMLButtonElement).hidden = !document.fullscreenEnabled;

async function toggleFullscreen(): Promise<void> {
  if (document.fullscreenElement) await document.exitFullscreen();
  else await document.documentElement.requestFullscreen();
}

const input = new CanvasInput(canvas, commands, nextFrame);
// Whoever is quicker than the fetch is heard, too.
canvas.addEventListener('dblclick', (event) => void handles.want().then((made) => made?.pickAt(event)));
// Captured, since the panel keeps the keys of its controls to itself, one that goes up there too.
const captured = { capture: true };
function keyDown(event: Event): void {
  if (!(event instanceof KeyboardEvent)) return; // a browser that fills in a form sends a plain one
  connection.wake();
  if (event.key.toLowerCase() === 'k' && (event.ctrlKey || event.metaKey)) {
    event.preventDefault();
    help.close();
    if (!tokenDialog.open) doings.search(); // nothing can be done before
    return;
  }
  // Single keys are the picture's, so that nobody who types or speaks sets one off (WCAG 2.1.4).
  if (event.target !== canvas) return;
  if (input.keyDown(event)) {
    event.preventDefault();
    return;
  }
  if (event.repeat || event.ctrlKey || event.metaKey || event.altKey) return;
  const entry = entryOf(event.key, keyed());
  if (!entry) return;
  event.preventDefault();
  entry.run();
}
window.addEventListener('keydown', keyDown, captured);
window.addEventListener('keyup', (event: Event) => event instanceof KeyboardEvent && input.keyUp(event), captured);
window.addEventListener('blur', () => input.releaseAll());
document.addEventListener('visibilitychange', () => tellVisibility(false));
canvas.addEventListener('pointerdown', () => connection.wake());
window.addEventListener('online', () => connection.back());
presenter.setVisible(!document.hidden);

/** A hidden page paints nothing, so the server need not draw. A new connection knows of no pause. */
function tellVisibility(newConnection: boolean): void {
  const { hidden } = document;
  presenter.setVisible(!hidden);
  if (hidden) input.releaseAll();
  if (!hidden && !newConnection) connection.back();
  const { link, server } = store.state;
  const understood = link.phase === 'live' && (server?.protocolMinor ?? 0) >= kMinorOfPause;
  if (understood && (hidden || !newConnection)) {
    connection.send({ case: 'pause', value: { paused: hidden } });
  }
}

canvas.focus({ preventScroll: true });
// A module that waits for something itself would be cut into pieces, some kilobytes more of them.
void decodableCodecs().then((decoded) => {
  codecs = decoded;
  begin();
});

function begin(): void {
  if (wasOpen('settings')) void panel.want();
  address.read();
  if ('problem' in wantedRoom) {
    const link: Link = { phase: 'refused', reason: wantedRoom.problem, remedy: null };
    store.dispatch({ type: 'link', link });
  } else {
    void resume.claim(kClaimMs).then(() => connection.open());
  }
}
