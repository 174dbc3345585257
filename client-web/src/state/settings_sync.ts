// Tells the server what the viewer changed. Settings go out at once and one by one, in order; the
// camera at most once an animation frame, the latest pose only.

import type { ClientBody } from '../protocol/framing';
import { cameraCommand, settingCommands } from '../settings/setting_commands';
import { cameraOf, type Settings } from '../settings/settings';
import type { AppState } from './app_state';
import { mayControl } from './room';
import type { Store } from './store';

export interface Sender {
  send(body: ClientBody): bigint | null;
  readonly backlogBytes: number;
}

/** A camera on its way out behind this much would be old when it arrives. */
const kMaxBacklogBytes = 16 * 1024;

export class SettingsSync {
  private framePending = false;

  constructor(
    private readonly store: Store,
    private readonly sender: Sender,
    private readonly nextFrame: (action: (nowMs: number) => void) => void,
    /** With the camera to tell while the view moves; in the end with its own. */
    private readonly asked: (settings: Settings, nowMs: number) => Settings = (settings) => settings,
  ) {
    // Between actions that wait, `sent` does not hold yet what went out: it would go out twice.
    store.listenSettled((state) => this.changed(state));
  }

  private changed({ link, settings, sent, room }: AppState): void {
    if (!mayControl(room)) return;
    if (link.phase !== 'live' || !settings || !sent || settings === sent) return;
    const commands = settingCommands(sent, settings);
    const camera = cameraCommand(sent, settings);
    if (commands.length > 0) {
      this.tell(commands, camera ? { ...settings, ...cameraOf(sent) } : settings);
    } else if (!camera) {
      this.store.dispatch({ type: 'sent', seq: this.store.state.sentSeq, settings });
    }
    if (camera) this.scheduleCamera();
  }

  private scheduleCamera(): void {
    if (this.framePending) return;
    this.framePending = true;
    this.nextFrame((nowMs) => {
      this.framePending = false;
      const { link, settings, sent, room } = this.store.state;
      if (link.phase !== 'live' || !settings || !sent || !mayControl(room)) return;
      if (!cameraCommand(sent, settings)) return;
      const told = this.asked(settings, nowMs);
      const command = cameraCommand(sent, told);
      if (!command || this.sender.backlogBytes > kMaxBacklogBytes) this.scheduleCamera();
      else this.tell([command], told);
    });
  }

  private tell(commands: readonly ClientBody[], settings: Settings): void {
    let seq: bigint | null = null;
    for (const command of commands) {
      seq = this.sender.send(command);
      if (seq === null) return; // closed meanwhile: all is told again after the next Welcome
    }
    if (seq !== null) this.store.dispatch({ type: 'sent', seq, settings });
  }
}
