// Keeps the address and the settings alike: reads it when the page opens or it is edited, writes it
// a moment after a change.

import { Codec } from '../gen/froxel/v1/common_pb';
import { cameraCommand, settingCommands } from '../settings/setting_commands';
import type { Settings } from '../settings/settings';
import { formatAddress, linkTo, parseAddress } from './address';
import type { AppState } from './app_state';
import type { Store } from './store';

const kWriteDelayMs = 400; // browsers limit how often an address may change

export class AddressKeeper {
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
    const { settings, size, scene, problems: unread } = parseAddress(location.hash);
    const problems = [...unread];
    const { codec, ...others } = settings;
    const decodes = codec === undefined || this.codecs().includes(codec);
    if (!decodes) {
      problems.push(`link: codec=${Codec[codec].toLowerCase()} is not decoded by this browser here; video needs WebCodecs, and those https`);
    }
    const first = this.store.state.settings === null ? this.wishes : {};
    const wanted = { ...first, ...(decodes ? settings : others) };
    this.store.dispatch({ type: 'restored', wanted, size, scene });
    if (problems.length > 0) {
      this.store.dispatch({ type: 'notice', tone: 'error', text: problems.join('; ') });
    }
  }

  async copy(): Promise<void> {
    this.write();
    let text = 'The link to this view is on the clipboard.';
    try {
      await navigator.clipboard.writeText(linkTo(location.href, document.baseURI));
    } catch {
      text = 'Copy the link from the address bar.'; // no clipboard without https, or forbidden
    }
    this.store.dispatch({ type: 'notice', tone: 'info', text });
  }

  private changed(state: AppState, before: AppState): void {
    const sizeChosen = before.sizeMode !== null && state.sizeMode !== before.sizeMode;
    const sceneChanged = before.server !== null && sceneOf(state) !== sceneOf(before);
    if (!sizeChosen && !sceneChanged && !edited(before, state)) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.write(), kWriteDelayMs);
  }

  private write(): void {
    clearTimeout(this.timer);
    const { settings, sizeMode, server } = this.store.state;
    if (!settings || !sizeMode || !server) return;
    history.replaceState(null, '', `#${formatAddress(settings, sizeMode, server.initial, sceneOf(this.store.state))}`);
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
