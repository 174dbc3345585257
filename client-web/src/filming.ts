// Camera paths and recordings: their cards, and what these do with the store and the commands. Fetched when first wanted.

import { PathCard, type PathActions } from './cards/path_card';
import { RecordCard, type RecordActions } from './cards/record_card';
import type { Commands } from './commands';
import type { Size } from './core/size';
import type { View } from './path/camera_path';
import { toVec, type Bounds, type Settings } from './settings/settings';
import type { ServerFiles } from './protocol/server_files';
import type { Store } from './state/store';

export class Filming implements PathActions, RecordActions {
  readonly path: PathCard;
  readonly recording: RecordCard;

  constructor(
    private readonly store: Store,
    private readonly commands: Commands,
    files: ServerFiles,
    nextFrame: (action: (nowMs: number) => void) => void,
  ) {
    this.recording = new RecordCard(this, files, () => this.path.path);
    this.path = new PathCard(this, { record: () => this.recording.toggle(), nextFrame });
    this.path.read(store.state.path);
  }

  perspective(): View | null {
    const view = this.commands.view();
    return view === null || view.orthographic ? null : view;
  }

  setView({ eye, target, up, fovDeg }: View): void {
    this.commands.edit({ eye, target, up, fovDeg });
  }

  /** The scene's cameras in perspective. */
  sceneViews(): View[] {
    const views = this.store.state.server?.scene?.cameraViews ?? [];
    return views
      .filter(({ fovDeg }) => fovDeg > 0)
      .map(({ pose, fovDeg }) => ({ eye: toVec(pose?.eye), target: toVec(pose?.target), up: toVec(pose?.up), fovDeg }));
  }

  sceneBounds(): Bounds | null {
    return this.store.state.server?.bounds ?? null;
  }

  keepPath(path: string): void {
    this.store.dispatch({ type: 'path', path });
  }

  pictureSize(): Size | null {
    return this.commands.pictureSize();
  }

  frame(size: Size, timeS: number, view: View | null): string {
    const { settings } = this.store.state;
    if (settings === null) return this.commands.pngOf(size, null);
    const camera = view && { eye: view.eye, target: view.target, up: view.up, fovDeg: view.fovDeg, orthographic: false };
    const clocks = {
      ...(settings.animate && { lightTime: timeS }),
      ...(settings.animation > 0 && settings.animationPlaying && { animationTime: this.played(settings, timeS) }),
    };
    return this.commands.pngOf(size, { ...settings, ...camera, ...clocks });
  }

  /** Seconds of the animation, which begins at its end where it plays backwards. */
  private played({ animation, animationSpeed }: Settings, timeS: number): number {
    const durationS = this.store.state.server?.scene?.animations[animation - 1]?.durationS ?? 0;
    const start = animationSpeed < 0 ? durationS * Math.ceil((-animationSpeed * timeS) / Math.max(durationS, 1e-3)) : 0;
    return Math.max(0, start + timeS * animationSpeed);
  }
}
