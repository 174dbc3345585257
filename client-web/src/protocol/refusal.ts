// Before a WebSocket there is HTTP: what its URL announces, and why a server declined it. A page is
// told no status of a WebSocket that was declined, so it asks again by a plain GET.

/** Public digits of a resume token: by them a server knows that a session of its own is meant. */
const kResumeNameDigits = 16;
const kLongestReason = 300;
const kPatienceMs = 5_000;

export interface Refusal {
  readonly reason: string;
  /** The code that a WebSocket would have been closed with; 0: none was told. */
  readonly closeCode: number;
  readonly retryAfterMs: number;
}

/**
 * The socket's URL with what decides whether there is a place: the room, and whose session. A room's path is
 * its own, so that any proxy can lead all of a room to one server.
 */
export function announced(url: string, room: string, resumeToken: string): string {
  const target = new URL(url);
  if (room !== '') {
    target.pathname = target.pathname.replace(/(^|\/)ws$/, '$1rooms/ws');
    target.searchParams.set('room', room);
  }
  if (resumeToken !== '') {
    target.searchParams.set('resume', resumeToken.slice(0, kResumeNameDigits));
  }
  return target.href;
}

/** Why the server would decline a socket at this URL; null: it would not, or cannot be asked. */
export async function askRefusal(url: string): Promise<Refusal | null> {
  try {
    const response = await fetch(url.replace(/^ws/, 'http'), {
      cache: 'no-store',
      signal: AbortSignal.timeout(kPatienceMs),
    });
    const plain = response.headers.get('Content-Type')?.startsWith('text/plain') ?? false;
    if (response.status !== 503 || !plain) return null;
    const seconds = Number(response.headers.get('Retry-After') ?? '0');
    return {
      closeCode: Number(response.headers.get('Froxel-Close-Code') ?? '0'),
      reason: (await response.text()).trim().slice(0, kLongestReason),
      retryAfterMs: Number.isFinite(seconds) ? Math.max(0, seconds * 1000) : 0,
    };
  } catch {
    return null; // no network, or another site that cannot be asked
  }
}
