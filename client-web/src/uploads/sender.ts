// Sends a scene's files to the server, by tus 1.0.0: protocol/README.md, Uploads. A lost connection
// goes on where it was.

import type { BroughtFile } from './dropped';

export interface Sent {
  readonly id: string;
  readonly ownerKey: string;
}

/** Why the server takes it not: in its words. */
export class Refused extends Error {}

export interface Transport {
  /** `body`: null: none. Rejects where there is no answer; `told` hears how many bytes have gone. */
  ask(
    method: string,
    path: string,
    fields: Readonly<Record<string, string>>,
    body: Blob | string | null,
    signal: AbortSignal,
    told?: (bytes: number) => void,
  ): Promise<{ readonly status: number; readonly field: (name: string) => string | null; readonly text: string }>;
  /** After so long; at once when it is called off. */
  wait(ms: number, signal: AbortSignal): Promise<void>;
}

interface Announced {
  readonly id: string;
  readonly owner_key: string;
  readonly files: readonly { readonly path: string; readonly upload: string }[];
}

const kTus = { 'Tus-Resumable': '1.0.0' };
const kPartBytes = 8 * 2 ** 20;
const kAtOnce = 3; // files
const kTries = 6; // in a row, without a byte that came
const kPauseMs = 500; // before the second; twice as long each time

/**
 * `told` hears of the bytes that have gone, of all. Rejects with Refused, with what `signal` was called off for, or
 * where no connection comes any more; what was sent is removed then.
 */
export async function sendScene(
  files: readonly BroughtFile[],
  transport: Transport,
  signal: AbortSignal,
  told: (bytes: number) => void,
): Promise<Sent> {
  const announcement = { files: files.map(({ path, blob }) => ({ path, bytes: blob.size })) };
  const begun = await transport.ask('POST', 'api/v1/scenes', {}, JSON.stringify(announcement), signal);
  if (begun.status !== 201) throw new Refused(messageOf(begun.text, begun.status));
  const { id, owner_key: ownerKey, files: uploads } = JSON.parse(begun.text) as Announced;
  const gone = files.map(() => 0);
  const tell = (): void => told(gone.reduce((sum, bytes) => sum + bytes, 0));
  const waiting = uploads.map(({ upload }, place) => ({ upload, place }));
  const sendNext = async (): Promise<void> => {
    for (let next = waiting.shift(); next; next = waiting.shift()) {
      const { upload, place } = next;
      const blob = files[place]?.blob;
      if (!blob) continue;
      await sendFile(blob, upload.replace(/^\//, ''), transport, signal, (bytes) => {
        gone[place] = bytes;
        tell();
      });
    }
  };
  try {
    await Promise.all(Array.from({ length: kAtOnce }, sendNext));
  } catch (error) {
    void removeScene({ id, ownerKey }, transport).catch(() => false); // else the server does, in the end
    throw error;
  }
  return { id, ownerKey };
}

/** Whether it is gone now, or was before. */
export async function removeScene({ id, ownerKey }: Sent, transport: Transport): Promise<boolean> {
  const fields = { 'Froxel-Owner-Key': ownerKey };
  const { status } = await transport.ask('DELETE', `api/v1/scenes/${id}`, fields, null, new AbortController().signal);
  return status === 204 || status === 404;
}

async function sendFile(
  blob: Blob,
  upload: string,
  transport: Transport,
  signal: AbortSignal,
  told: (bytes: number) => void,
): Promise<void> {
  let offset = 0;
  let tries = 0;
  while (offset < blob.size) {
    signal.throwIfAborted();
    try {
      const part = blob.slice(offset, offset + kPartBytes);
      const from = offset;
      const fields = {
        ...kTus,
        'Content-Type': 'application/offset+octet-stream',
        'Upload-Offset': String(offset),
      };
      const answer = await transport.ask('PATCH', upload, fields, part, signal, (bytes) => told(from + bytes));
      if (answer.status === 204) {
        offset = Number(answer.field('Upload-Offset'));
        tries = 0;
        told(offset);
        continue;
      }
      if (!mayPass(answer.status)) throw new Refused(messageOf(answer.text, answer.status));
    } catch (error) {
      if (error instanceof Refused || signal.aborted) throw error;
    }
    if (++tries >= kTries) throw new Error('The connection to the server was lost.');
    await transport.wait(kPauseMs * 2 ** (tries - 1), signal);
    const standing = await transport.ask('HEAD', upload, kTus, null, signal).catch(() => null);
    if (standing?.status === 404) throw new Refused('The server does not have this upload any more.');
    if (standing?.status === 200) {
      const there = Number(standing.field('Upload-Offset'));
      if (there > offset) tries = 0;
      offset = there;
    }
  }
}

/** Another offset, a connection that the server holds for alive, a pause, and what a proxy says of a server. */
const mayPass = (status: number): boolean => [408, 409, 423, 429, 502, 503, 504].includes(status);

function messageOf(text: string, status: number): string {
  try {
    const { message } = JSON.parse(text) as { readonly message?: unknown };
    if (typeof message === 'string') return message;
  } catch {
    // a proxy's own page
  }
  return `The server answered ${status}.`;
}
