// What the page says about how it stands, one line at a time. Pure.

import { count } from '../core/format';
import { RendererSchema } from '../gen/froxel/v1/common_pb';
import type { FrameHeader } from '../gen/froxel/v1/server_pb';
import type { Remedy } from '../protocol/connection';
import { nameIn } from '../protocol/schema_names';
import type { AppState, Loading } from './app_state';

export interface Standing {
  readonly text: string; // '': nothing to say
  readonly tone: 'error' | 'info';
  readonly aside: string; // what of it changes by the second; not read aloud
  readonly remedy: Remedy | null;
  /** How far it is with what is on its way, where `text` does not say it; null: nothing is. */
  readonly progress: { readonly text: string; readonly fraction: number | null } | null;
  /** The picture that is shown, if any, is an old one. */
  readonly dims: boolean;
}

/** A picture that shows nothing of what was asked for so long ago is a slow one. */
export const kSlowMs = 3_000;

const kDismiss: Remedy = { label: 'Dismiss', act: 'dismiss' };

export interface Moment {
  readonly nowMs: number;
  readonly hasPicture: boolean; // any was shown
  readonly lagMs: number; // for how long it has shown nothing of what was asked for
  readonly shown: FrameHeader | null; // of the picture that is shown
}

export function standingOf(state: AppState, { nowMs, hasPicture, lagMs, shown }: Moment): Standing {
  const { link, notice, loading, sceneLoading } = state;
  const live = link.phase === 'live';
  const well: Standing = {
    text: '',
    tone: 'info',
    aside: '',
    remedy: null,
    progress: hasPicture ? null : progressOf(state),
    dims: hasPicture && !live,
  };
  if (link.phase === 'waiting') {
    const seconds = Math.max(0, Math.ceil((link.retryAtMs - nowMs) / 1000));
    return {
      ...well,
      text: link.reason,
      tone: 'error',
      aside: `Next try in ${seconds} s.`,
      remedy: { label: 'Try now', act: 'connect' },
    };
  }
  if (link.phase === 'refused') {
    return { ...well, text: link.reason, tone: 'error', remedy: link.remedy };
  }
  if (notice) {
    const coming = sceneLoading ?? loading;
    const progress = well.progress ?? (coming && { text: loadingText(coming), fraction: coming.fraction });
    return { ...well, text: notice.text, tone: notice.tone, remedy: kDismiss, progress };
  }
  if (!hasPicture) return well;
  if (!live) {
    if (!loading) return { ...well, text: 'Connecting…' };
    return { ...well, text: 'The server restarted.', aside: `${loadingText(loading)}.` };
  }
  if (sceneLoading) {
    const remedy: Remedy = { label: 'Cancel', act: 'stay' };
    return { ...well, text: 'Another scene is loading.', aside: `${loadingText(sceneLoading)}.`, remedy };
  }
  if (loading) return { ...well, text: 'This view is drawn for the first time.', aside: `${loadingText(loading)}.` };
  if (shown && shown.fullSizeUs > 0) return { ...well, text: smallerText(state, shown) };
  if (lagMs < kSlowMs) return well;
  return {
    ...well,
    text: 'This view is slow to draw. Fewer lights or a smaller size draw faster.',
    aside: `${Math.floor(lagMs / 1000)} s behind.`,
  };
}

function smallerText({ confirmed }: AppState, { fullSizeUs, width, height }: FrameHeader): string {
  const seconds = (fullSizeUs / 1e6).toPrecision(2);
  const asked = confirmed ? ` at ${confirmed.width}×${confirmed.height}` : '';
  return `This machine needs ${seconds} s a picture${asked}; shown at ${width}×${height}.`;
}

function progressOf({ link, loading }: AppState): Standing['progress'] {
  if (link.phase === 'waiting' || link.phase === 'refused') return null;
  if (loading) return { text: loadingText(loading), fraction: loading.fraction };
  const text = link.phase === 'live' ? 'Waiting for the first picture…' : 'Connecting…';
  return { text, fraction: null };
}

function loadingText({ stage, fraction }: Loading): string {
  const known = fraction > 0 ? `, ${Math.round(fraction * 100)} %` : '';
  return `${stage.charAt(0).toUpperCase()}${stage.slice(1)}${known}`;
}

/** What a screen reader says of the picture. */
export function pictureLabel({ server, settings }: AppState): string {
  if (!server || !settings) return 'The picture, which has not arrived yet';
  const scene = server.scene?.name ?? 'No scene';
  const drawn = `drawn by ${nameIn(RendererSchema, settings.renderer)} with ${count(settings.lights)} lights`;
  return `${scene}, ${drawn}. Arrow keys turn the view, plus and minus zoom, question mark has all keys.`;
}
