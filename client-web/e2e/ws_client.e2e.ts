// A WebSocket stack that is neither Boost's nor a browser's (npm ws): what of RFC 6455 the server's
// own tests and the page leave out.

import { WebSocket } from 'ws';
import { afterAll, afterEach, beforeAll, expect, it } from 'vitest';

import { decodeBinary, encodeCommand, kProtocolMajor, type ClientBody, type Frame } from '../src/protocol/framing';
import { startServer, type Server } from './server';
import { until } from './viewer';

type Json = Record<string, Record<string, unknown> | undefined>;

let server: Server;
let socket: WebSocket;
let frames: Frame[];
let answers: Json[]; // the text messages
let pongs: string[];
let seq: number;

beforeAll(async () => {
  server = await startServer(0, ['--size', '64x48', '--lights', '8']);
});
afterAll(async () => {
  expect(await server.stop()).toBe(0);
});
afterEach(() => socket.terminate());

async function open(): Promise<void> {
  [frames, answers, pongs, seq] = [[], [], [], 0];
  socket = new WebSocket(`${server.url.replace('http:', 'ws:')}ws`, 'froxel.v1');
  socket.binaryType = 'arraybuffer';
  socket.on('pong', (data) => pongs.push(data.toString()));
  socket.on('message', (data, isBinary) => {
    if (!isBinary) {
      answers.push(JSON.parse(new TextDecoder().decode(data as ArrayBuffer)) as Json);
      return;
    }
    const received = decodeBinary(data as ArrayBuffer);
    if (received.kind === 'frame') frames.push(received.frame);
  });
  await new Promise((resolve, reject) => {
    socket.once('open', resolve).once('error', reject);
  });
}

function say(command: object): void {
  seq += 1;
  socket.send(JSON.stringify({ seq, ...command }));
}

function answer(kind: string): Promise<Record<string, unknown>> {
  return until(kind, () => answers.find((message) => kind in message)?.[kind]);
}

const hello = { hello: { protocolMajor: kProtocolMajor, clientName: 'npm ws' } };

/** Width and height by its SOF0; throws unless it goes from SOI to EOI by its segments. */
function jpegSize(bytes: Uint8Array): [number, number] {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  expect(view.getUint16(0)).toBe(0xffd8);
  expect(view.getUint16(bytes.length - 2)).toBe(0xffd9);
  let size: [number, number] = [0, 0];
  for (let at = 2; view.getUint16(at) !== 0xffda; at += 2 + view.getUint16(at + 2)) {
    expect(view.getUint8(at)).toBe(0xff);
    if (view.getUint16(at) === 0xffc0) size = [view.getUint16(at + 7), view.getUint16(at + 5)];
  }
  return size;
}

async function close(): Promise<void> {
  const closed = new Promise<number>((resolve) => socket.once('close', resolve));
  socket.close(1000, 'done');
  expect(await closed).toBe(1000);
}

it('Json_JoinsAndSteers_GetsPicturesAndAnswers', async () => {
  await open();
  expect([socket.protocol, socket.extensions]).toEqual(['froxel.v1', '']); // deflate was offered
  say(hello);
  expect(await answer('welcome')).toMatchObject({ protocolMajor: kProtocolMajor });
  const first = await until('a picture', () => frames[0]);
  expect(jpegSize(first.payload)).toEqual([64, 48]);

  // More than are sent without acknowledgements.
  for (let count = 0; count < 5; count += 1) {
    const frame = await until(`picture ${count}`, () => frames[count]);
    say({ ack: { frameId: String(frame.header.frameId) } });
  }
  say({ setRenderer: { renderer: 'RENDERER_NAIVE' } });
  expect(await answer('state')).toMatchObject({
    refSeq: String(seq),
    state: { renderer: 'RENDERER_NAIVE' },
  });
  say({ setExposure: { exposure: 'NaN' } });
  expect(await answer('error')).toMatchObject({
    refSeq: String(seq),
    code: 'ERROR_CODE_OUT_OF_RANGE',
    field: 'exposure',
  });
  await close();
});

it('Protobuf_SetSize_PicturesHaveIt', async () => {
  await open();
  const command = (body: ClientBody): void => {
    seq += 1;
    socket.send(encodeCommand(BigInt(seq), 0, body));
  };
  command({ case: 'hello', value: { protocolMajor: kProtocolMajor } });
  command({ case: 'setSize', value: { width: 50, height: 40 } });
  let acknowledged: Frame | undefined;
  const frame = await until('a picture of that size', () => {
    const newest = frames.at(-1);
    if (newest && newest !== acknowledged) {
      acknowledged = newest;
      command({ case: 'ack', value: { frameId: newest.header.frameId } });
    }
    return newest?.header.width === 50 ? newest : null;
  });
  expect(answers).toEqual([]); // the server speaks as Hello did
  expect(jpegSize(frame.payload)).toEqual([50, 40]);
  await close();
});

it('HelloInFragments_AmongPings_IsOneMessage', async () => {
  await open();
  const text = JSON.stringify({ seq: 1, ...hello });
  for (let at = 0; at < text.length; at += 1) {
    socket.send(text.charAt(at), { fin: at === text.length - 1 });
    if (at % 10 === 0) socket.ping(String(at));
  }
  await answer('welcome');
  await until('every pong', () => pongs.length === Math.ceil(text.length / 10));
  expect(pongs.map(Number)).toEqual(pongs.map((_, index) => index * 10));
  await until('a picture', () => frames[0]);
  await close();
});

it('NotTextAfterAll_Closes1007', async () => {
  await open();
  const closed = new Promise<number>((resolve) => socket.once('close', resolve));
  socket.send(Uint8Array.of(0xc3, 0x28), { binary: false });
  expect(await closed).toBe(1007);
});
