import { beforeEach, describe, expect, it } from 'vitest';

import { Refused, removeScene, sendScene, type Transport } from '../../src/uploads/sender';

interface Answer {
  readonly status: number;
  readonly fields?: Readonly<Record<string, string>>;
  readonly text?: string;
}

/** A server that keeps what comes, and fails as a test says. */
class FakeServer implements Transport {
  readonly asked: string[] = [];
  readonly waits: number[] = [];
  readonly content = new Map<string, string>();
  /** Of the next requests of a method: a lost connection, or another answer. */
  readonly next: { method: string; keeps: number; answer: Answer | null }[] = [];
  announced: unknown = null;

  async ask(method: string, path: string, fields: Readonly<Record<string, string>>, body: Blob | string | null, signal: AbortSignal, told?: (bytes: number) => void): ReturnType<Transport['ask']> {
    signal.throwIfAborted();
    this.asked.push(`${method} ${path}`);
    const trouble = this.next[0]?.method === method ? this.next.shift() : undefined;
    let answer: Answer = { status: 404 };
    if (method === 'POST') {
      this.announced = JSON.parse(body as string);
      const files = (this.announced as { files: { path: string }[] }).files.map(({ path: name }, i) => ({ path: name, upload: `/up/${i}` }));
      files.forEach(({ upload }) => this.content.set(upload.slice(1), ''));
      answer = { status: 201, text: JSON.stringify({ id: 'ID', owner_key: 'KEY', files }) };
    } else if (method === 'PATCH' && body instanceof Blob) {
      const text = await body.text();
      told?.(text.length);
      const before = this.content.get(path) ?? '';
      expect(fields['Upload-Offset']).toBe(String(before.length));
      this.content.set(path, before + text.slice(0, trouble?.keeps ?? text.length));
      answer = { status: 204, fields: { 'Upload-Offset': String(this.content.get(path)?.length) } };
    } else if (method === 'HEAD') {
      answer = { status: 200, fields: { 'Upload-Offset': String(this.content.get(path)?.length) } };
    } else if (method === 'DELETE') {
      expect(fields['Froxel-Owner-Key']).toBe('KEY');
      answer = { status: 204 };
    }
    if (trouble?.answer === null) {
      signal.throwIfAborted();
      throw new Error('lost');
    }
    const { status, fields: said = {}, text = '' } = trouble?.answer ?? answer;
    return { status, text, field: (name) => said[name] ?? null };
  }
  wait(ms: number): Promise<void> {
    this.waits.push(ms);
    return Promise.resolve();
  }
}

let server: FakeServer;
let told: number[];
const never = new AbortController().signal;
const file = (path: string, text: string): { path: string; blob: Blob } => ({ path, blob: new Blob([text]) });
const send = (...files: { path: string; blob: Blob }[]): Promise<unknown> =>
  sendScene(files, server, never, (bytes) => told.push(bytes));

beforeEach(() => {
  server = new FakeServer();
  told = [];
});

describe('sendScene', () => {
  it('AnnouncesAndSendsEachFile', async () => {
    expect(await send(file('a.gltf', 'scene'), file('t/b.png', 'pixels'))).toEqual({ id: 'ID', ownerKey: 'KEY' });
    expect(server.announced).toEqual({ files: [{ path: 'a.gltf', bytes: 5 }, { path: 't/b.png', bytes: 6 }] });
    expect([...server.content.values()]).toEqual(['scene', 'pixels']);
    expect(told.at(-1)).toBe(11);
  });

  it('LargeFiles_GoInParts', async () => {
    const text = 'x'.repeat(20 * 2 ** 20);
    await send(file('a.glb', text));
    expect(server.asked.filter((one) => one === 'PATCH up/0').length).toBe(3);
    expect(server.content.get('up/0')?.length).toBe(text.length);
  });

  it('LostConnection_GoesOnWhereItWas', async () => {
    server.next.push({ method: 'PATCH', keeps: 2, answer: null });
    await send(file('a.glb', 'scene'));
    expect(server.asked).toEqual(['POST api/v1/scenes', 'PATCH up/0', 'HEAD up/0', 'PATCH up/0']);
    expect(server.content.get('up/0')).toBe('scene');
  });

  it.each([409, 423, 429, 503])('Status %i_IsTriedAgain', async (status) => {
    server.next.push({ method: 'PATCH', keeps: 0, answer: { status } });
    await send(file('a.glb', 'scene'));
    expect(server.content.get('up/0')).toBe('scene');
  });

  it('ConnectionThatStaysAway_IsGivenUp_AndTheSceneRemoved', async () => {
    for (let i = 0; i < 6; ++i) server.next.push({ method: 'PATCH', keeps: 0, answer: null });
    await expect(send(file('a.glb', 'scene'))).rejects.toThrow('was lost');
    expect(server.waits).toEqual([500, 1000, 2000, 4000, 8000]);
    expect(server.asked.at(-1)).toBe('DELETE api/v1/scenes/ID');
  });

  it('Refusal_IsInTheServersWords', async () => {
    server.next.push({ method: 'POST', keeps: 0, answer: { status: 413, text: '{"message":"too large"}' } });
    await expect(send(file('a.glb', 'scene'))).rejects.toThrow(new Refused('too large'));
    server.next.push({ method: 'PATCH', keeps: 0, answer: { status: 507, text: '<html>' } });
    await expect(send(file('a.glb', 'scene'))).rejects.toThrow(new Refused('The server answered 507.'));
  });

  it('CalledOff_IsRemoved', async () => {
    const called = new AbortController();
    const sending = sendScene([file('a.glb', 'scene')], server, called.signal, () => called.abort(new Error('Cancelled.')));
    server.next.push({ method: 'PATCH', keeps: 1, answer: null });
    await expect(sending).rejects.toThrow('Cancelled.');
    expect(server.asked.at(-1)).toBe('DELETE api/v1/scenes/ID');
  });
});

it('removeScene_IsGoneEitherWay', async () => {
  expect(await removeScene({ id: 'ID', ownerKey: 'KEY' }, server)).toBe(true);
  server.next.push({ method: 'DELETE', keeps: 0, answer: { status: 404 } });
  expect(await removeScene({ id: 'ID', ownerKey: 'KEY' }, server)).toBe(true);
  server.next.push({ method: 'DELETE', keeps: 0, answer: { status: 503 } });
  expect(await removeScene({ id: 'ID', ownerKey: 'KEY' }, server)).toBe(false);
});
