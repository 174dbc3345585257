// The frames of a recording: when each is due, where the camera is then, and how they are fetched.

/** Of a whole recording: about two minutes at 30 frames a second. `froxel record` has no such limit. */
export const kMostFrames = 3_600;
/** Requests at once: the server draws the next frames while this one is encoded. */
const kAhead = 3;
/** Of a server that is busy, until a frame counts as refused. */
const kTries = 20;
const kShortestWaitS = 1;

export interface Answer {
  readonly ok: boolean;
  readonly status: number;
  readonly headers: { get(name: string): string | null };
}

export const frameCount = (seconds: number, framesPerS: number): number => Math.max(1, Math.round(seconds * framesPerS));

/** What keeps a recording from being made; empty: nothing. */
export function problemOf(seconds: number, framesPerS: number): string {
  if (!(seconds > 0)) return 'The duration must be more than 0 seconds.';
  const count = frameCount(seconds, framesPerS);
  if (count <= kMostFrames) return '';
  return `${count} frames are too many; a recording on the page may have ${kMostFrames}. Choose fewer frames a second or a shorter duration, or use froxel record.`;
}

/** A busy server says when to come back (429 and 503). Any other answer is the caller's. */
export async function patiently<T extends Answer>(
  ask: () => Promise<T>,
  wait: (seconds: number) => Promise<void>,
): Promise<T> {
  for (let tries = 1; ; tries += 1) {
    const answer = await ask();
    if ((answer.status !== 429 && answer.status !== 503) || tries === kTries) return answer;
    await wait(Math.max(kShortestWaitS, Number(answer.headers.get('Retry-After') ?? 0) || 0));
  }
}

/** Gives each frame to `take` in order; `get` runs ahead of it. Ends early, by its reason, when `signal` is aborted. */
export async function inOrder<T>(
  count: number,
  get: (index: number) => Promise<T>,
  take: (frame: T, index: number) => Promise<void>,
  signal: AbortSignal,
): Promise<void> {
  const coming: Promise<T>[] = [];
  const ask = (index: number): void => {
    const frame = get(index);
    frame.catch(() => undefined); // told when its turn comes
    coming.push(frame);
  };
  for (let index = 0; index < Math.min(kAhead, count); index += 1) ask(index);
  for (let index = 0; index < count; index += 1) {
    signal.throwIfAborted();
    const frame = await coming[index];
    if (index + kAhead < count) ask(index + kAhead);
    signal.throwIfAborted();
    if (frame !== undefined) await take(frame, index);
  }
}
