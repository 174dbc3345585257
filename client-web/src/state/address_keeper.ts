// Keeps the address and the settings alike: reads it when the page opens or it is edited, writes it
// a moment after a change.

import { messageOf } from '../core/format';
import { Codec } from '../gen/froxel/v1/common_pb';
import { cameraCommand, settingCommands } from '../settings/setting_commands';
import type { Settings } from '../settings/settings';
import { formatAddress, isLoopback, linkTo, parseAddress, roomLink } from './address';
import type { AppState } from './app_state';
import type { SizeMode } from './size_policy';
import type { Store } from './store';

const kWriteDelayMs = 400; // browsers limit how often an address may change

export class AddressKeeper {
  private usualSize: SizeMode | null = null; // what the page chose by itself
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** `codecs` are those that this browser decodes. `wishes` are what is set unless the address says otherwise. */
  constructor(
    private readonly store: Store,
    private readonly codecs: () => readonly Codec[],
    private readonly wishes: Partial<Settings>,
  ) {
    store.listen((state, before) => this.changed(state, before));
    window.addEventListener('hashchange', () => this.read());
  }

  read(): void {
    const { settings, size, scene, lightSet, path, problems: unread } = parseAddress(location.hash);
    const problems = [...unread];
    const { codec, ...others } = settings;
    const decodes = codec === undefined || this.codecs().includes(codec);
    if (!decodes) {
      problems.push(`link: codec=${Codec[codec].toLowerCase()} cannot be decoded here; video needs WebCodecs, which need https`);
    }
    const first = this.store.state.settings === null ? this.wishes : {};
    const wanted = { ...first, ...(decodes ? settings : others) };
    this.store.dispatch({ type: 'restored', wanted, size, scene, path });
    if (lightSet !== null) void this.readLights(lightSet, wanted, scene);
    if (problems.length > 0) {
      this.store.dispatch({ type: 'notice', tone: 'error', text: problems.join('; ') });
    }
  }

  private async readLights(text: string, wanted: Partial<Settings>, scene: string | null): Promise<void> {
    try {
      const { lightSetOf } = await import('../settings/light_set');
      const placedLights = lightSetOf(text);
      const all = this.store.state.settings === null || this.store.state.wantedScene !== null;
      this.store.dispatch({ type: 'restored', wanted: { ...(all && wanted), placedLights }, size: null, scene });
    } catch (error) {
      const why = messageOf(error);
      this.store.dispatch({ type: 'notice', tone: 'error', text: `link: placed_lights is not a light set: ${why}` });
    }
  }

  /** A link to this view. */
  copy(): Promise<void> {
    this.write();
    return this.copyLink('this view', linkTo(location.href, document.baseURI));
  }

  /** A link to a room, whose view is that of who controls it. */
  copyRoom(name: string): Promise<void> {
    return this.copyLink('this room', roomLink(name, document.baseURI));
  }

  private async copyLink(what: string, link: string): Promise<void> {
    let copied = true;
    try {
      await navigator.clipboard.writeText(link);
    } catch {
      copied = false; // no clipboard without https, or forbidden
    }
    const said = copied ? `The link to ${what} is on the clipboard.` : `Copy the link to ${what}: ${link}`;
    const { hostname } = new URL(link);
    const alone = isLoopback(hostname) ? ` It does not work on other computers: ${hostname} is every computer's own name.` : '';
    this.store.dispatch({ type: 'notice', tone: 'info', text: said + alone, stays: !copied || alone !== '' });
  }

  private changed(state: AppState, before: AppState): void {
    if (before.sizeMode === null && before.server !== null) this.usualSize = state.sizeMode;
    const sizeChosen = before.sizeMode !== null && state.sizeMode !== before.sizeMode;
    const sceneChanged = before.server !== null && sceneOf(state) !== sceneOf(before);
    const pathChanged = before.server !== null && state.path !== before.path;
    if (!sizeChosen && !sceneChanged && !pathChanged && !edited(before, state)) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.write(), kWriteDelayMs);
  }

  /** Brings the address up to date now. */
  write(): void {
    clearTimeout(this.timer);
    const { settings, sizeMode, server, path } = this.store.state;
    if (!settings || !sizeMode || !server) return;
    const size = sizeMode === this.usualSize ? null : sizeMode;
    history.replaceState(null, '', `#${formatAddress(settings, size, server.initial, sceneOf(this.store.state), path)}`);
  }
}

const sceneOf = ({ server }: AppState): string => server?.scene?.id ?? '';

/** Whether more changed than what Welcome brings and what follows the window's size. */
function edited({ settings: before }: AppState, { settings: after, sizeMode }: AppState): boolean {
  if (!before || !after || before === after) return false;
  const followsWindow = sizeMode?.kind !== 'fixed';
  const commands = settingCommands(before, after);
  return (
    commands.some((command) => command.case !== 'setSize' || !followsWindow) ||
    // One that is followed moves all the time.
    (after.followedCamera === '' && cameraCommand(before, after) !== null)
  );
}
