import { beforeEach, describe, expect, it } from 'vitest';

import { Connection, type Link } from '../../src/protocol/connection';
import { FakeEnvironment } from '../fakes';

let env: FakeEnvironment;
let connection: Connection;
let links: Link[];
let problems: string[];
let messages: (string | undefined)[];
let tokensWanted: number;
const phases = (): string[] => links.map((link) => link.phase);

beforeEach(() => {
  env = new FakeEnvironment();
  links = [];
  problems = [];
  messages = [];
  tokensWanted = 0;
  connection = new Connection(
    'ws://host/ws',
    {
      link: (link) => void links.push(link),
      message: (message) => void messages.push(message.body.case),
      frame: () => undefined,
      depth: () => undefined,
      tokenWanted: () => void (tokensWanted += 1),
      problem: (text) => void problems.push(text),
    },
    env,
  );
  connection.open();
});

describe('Connection', () => {
  it('Open_AsksForTheSubprotocolAndSaysHelloFirst', () => {
    expect(env.socket.url).toBe('ws://host/ws');
    expect(env.socket.subprotocol).toBe('froxel.v1');
    expect(env.socket.binaryType).toBe('arraybuffer');
    env.socket.accept();
    expect(env.socket.sent).toMatchObject([
      { seq: 1n, clientTimeUs: 1_000_000n, body: { case: 'hello', value: { protocolMajor: 1 } } },
    ]);
    expect(phases()).toEqual(['connecting', 'greeting']);
  });

  it('Hello_NamesTheRoom_AndTheSessionToTakeUpOnceItIsKnown', () => {
    env.room = 'hall';
    env.socket.accept();
    const hello = (): unknown => env.socket.sent[0]?.body;
    expect(hello()).toMatchObject({ value: { room: 'hall', resumeToken: '' } });
    env.token = 'secret';
    env.socket.drop(1006);
    env.pass(10_000);
    env.socket.accept();
    expect(hello()).toMatchObject({ value: { room: 'hall', resumeToken: 'secret' } });
  });

  it('Send_WhileClosed_IsNullAndSendsNothing', () => {
    expect(connection.send({ case: 'ping', value: {} })).toBeNull();
    expect(env.socket.sent).toEqual([]);
  });

  it('Send_CountsUp', () => {
    env.socket.accept();
    expect(connection.send({ case: 'ping', value: {} })).toBe(2n);
    expect(connection.send({ case: 'ping', value: {} })).toBe(3n);
  });

  it('Loss_IsFollowedByANewConnectionThatCountsFromOne', () => {
    env.socket.accept();
    connection.send({ case: 'ping', value: {} });
    env.socket.drop(1006);
    expect(links.at(-1)).toMatchObject({ phase: 'waiting', retryAtMs: 1500 });
    env.pass(499);
    expect(env.sockets.length).toBe(1);
    env.pass(1);
    expect(env.sockets.length).toBe(2);
    env.socket.accept();
    expect(env.socket.sent[0]?.seq).toBe(1n);
  });

  it('LossAfterLoss_WaitsLonger', () => {
    env.randomValue = 0.5;
    const delays: number[] = [];
    for (let i = 0; i < 4; i += 1) {
      env.socket.drop(1006);
      const link = links.at(-1);
      if (link?.phase !== 'waiting') throw new Error('not waiting');
      delays.push(link.retryAtMs - env.now);
      env.pass(link.retryAtMs - env.now);
    }
    expect(delays).toEqual([750, 1250, 2250, 4250]);
  });

  it('AServerThatAcceptsAndCloses_IsTriedEverMoreSeldom', () => {
    env.randomValue = 0.5;
    const delays: number[] = [];
    for (let i = 0; i < 4; i += 1) {
      env.socket.accept();
      env.pass(100);
      env.socket.drop(1006);
      const link = links.at(-1);
      if (link?.phase !== 'waiting') throw new Error('not waiting');
      delays.push(link.retryAtMs - env.now);
      env.pass(link.retryAtMs - env.now);
    }
    expect(delays).toEqual([750, 1250, 2250, 4250]);
  });

  it('AStableConnection_MakesTheNextDelaySmallAgain', () => {
    env.randomValue = 0.5;
    for (let i = 0; i < 4; i += 1) {
      env.socket.drop(1006);
      env.pass(10_000);
    }
    env.socket.accept();
    env.pass(4_900);
    env.socket.say({ case: 'pong', value: {} });
    env.pass(200);
    env.socket.drop(1006);
    expect(links.at(-1)).toMatchObject({ phase: 'waiting', retryAtMs: env.now + 750 });
  });

  it.each([1008, 1009, 4001, 4009])('Close_With%i_IsNotTriedAgain', (code) => {
    env.socket.accept();
    env.socket.drop(code, 'why');
    expect(links.at(-1)).toMatchObject({ phase: 'refused' });
    env.pass(60_000);
    expect(env.sockets.length).toBe(1);
  });

  it.each([1000, 1001, 4008, 4010, 4029, 4030, 4031, 4032, 4033, 4050])('Close_With%i_IsTriedAgain', (code) => {
    env.socket.accept();
    env.socket.drop(code);
    env.pass(10_000);
    expect(env.sockets.length).toBe(2);
  });

  it('Silence_InSpiteOfPings_IsALoss', () => {
    env.socket.accept();
    env.pass(15_000);
    expect(env.socket.said).toEqual(['hello', 'ping', 'ping', 'ping']);
    expect(env.socket.closedByPage).toBe(false);
    const first = env.socket;
    env.pass(5_000);
    expect(first.closedByPage).toBe(true);
    expect(links.at(-1)?.phase).toBe('waiting');
    first.drop(1006); // the browser's late word about it changes nothing
    expect(phases().filter((phase) => phase === 'waiting').length).toBe(1);
  });

  it('AnsweredPings_KeepTheConnection', () => {
    env.socket.accept();
    for (let i = 0; i < 20; i += 1) {
      env.pass(5_000);
      env.socket.say({ case: 'pong', value: {} });
    }
    expect(env.sockets.length).toBe(1);
    expect(env.socket.closedByPage).toBe(false);
  });

  it('Garbage_IsReportedAndTheConnectionStays', () => {
    env.socket.accept();
    env.socket.deliver(new Uint8Array([1, 2, 3, 4]).buffer);
    env.socket.deliver('text');
    expect(problems.length).toBe(2);
    env.socket.say({ case: 'pong', value: {} });
    expect(messages).toEqual(['pong']);
  });

  it('Leave_GoesElsewhereWithinHalfTheDeadline_LaterThereAndHereInTurns', () => {
    env.socket.accept();
    const first = env.socket;
    env.randomValue = 0.5;
    connection.leave(4_000, 'wss://other/ws');
    env.pass(999);
    expect(env.sockets.length).toBe(1);
    env.pass(1);
    expect(env.socket.url).toBe('wss://other/ws');
    expect(first.closedByPage).toBe(true);
    env.socket.accept();
    const tried: string[] = [];
    for (let i = 0; i < 3; i += 1) {
      env.socket.drop(1006);
      env.pass(10_000);
      tried.push(env.socket.url);
    }
    expect(tried).toEqual(['wss://other/ws', 'ws://host/ws', 'wss://other/ws']);
    env.socket.drop(1006);
    env.pass(10_000);
    env.socket.accept();
    env.socket.drop(1006);
    env.pass(10_000);
    expect(env.socket.url).toBe('ws://host/ws'); // back home
  });

  it('Leave_ToAnAddressThatDoesNotAnswer_ComesBack', () => {
    env.socket.accept();
    connection.leave(0, 'wss://other/ws');
    env.pass(0);
    expect(env.socket.url).toBe('wss://other/ws');
    env.socket.drop(1006);
    env.pass(10_000);
    expect(env.socket.url).toBe('ws://host/ws');
  });

  it('Leave_WithoutAnAddress_OpensThisOneAgain_UnlessItClosedBefore', () => {
    env.socket.accept();
    connection.leave(4_000, '');
    env.pass(0);
    expect(env.sockets.map(({ url }) => url)).toEqual(['ws://host/ws', 'ws://host/ws']);
    env.randomValue = 0.9;
    connection.leave(60_000, '');
    env.socket.drop(4010);
    env.pass(60_000);
    expect(env.sockets.length).toBe(3); // by the reconnect alone
  });

  it('Close_With4003_AsksForAToken_AndTheNextHelloHasIt', () => {
    env.socket.accept();
    env.socket.drop(4003, 'no valid token');
    expect(tokensWanted).toBe(1);
    env.pass(60_000);
    expect(env.sockets.length).toBe(1);
    env.accessToken = 'correct-horse-battery';
    connection.open();
    env.socket.accept();
    expect(env.socket.sent[0]?.body).toMatchObject({ value: { token: 'correct-horse-battery' } });
  });

  it('Declined_WhileFull_SaysWhyAndWaitsAsTold', async () => {
    env.refusal = { reason: 'not yet', closeCode: 0, retryAfterMs: 5_000 };
    env.randomValue = 0.5;
    env.socket.drop(1006);
    await Promise.resolve();
    expect(links.at(-1)).toEqual({
      phase: 'waiting',
      reason: 'The server has no place for you now: not yet.',
      retryAtMs: env.now + 7_500,
    });
    env.pass(7_499);
    expect(env.sockets.length).toBe(1);
    env.pass(1);
    expect(env.sockets.length).toBe(2);
  });

  it('NoPlace_SaysWhichOneAndWhatHelps_DeclinedOrClosed', async () => {
    const said = new Set<string>();
    for (const closeCode of [4029, 4030, 4031, 4032, 4033]) {
      env.refusal = { reason: 'for the log', closeCode, retryAfterMs: 5_000 };
      env.socket.drop(1006);
      await Promise.resolve();
      const declined = links.at(-1);
      connection.open();
      env.socket.accept();
      env.socket.drop(closeCode);
      expect(links.at(-1)).toMatchObject({ phase: 'waiting', reason: declined && 'reason' in declined && declined.reason });
      if (declined && 'reason' in declined) said.add(declined.reason);
      connection.open();
    }
    expect(said.size).toBe(5);
    expect([...said].join(' ')).not.toMatch(/ms|for the log|No connection/);
  });

  it('Declined_ThoughItWouldBeLetInNow_IsTriedAgainSoon', async () => {
    env.socket.drop(1006);
    await Promise.resolve();
    env.pass(500);
    expect(env.sockets.length).toBe(2);
  });

  it('Lost_AfterItWasOpen_AsksNobodyWhy', () => {
    env.socket.accept();
    env.socket.drop(4029);
    expect(env.asked).toEqual([]);
  });

  it('Url_AnnouncesTheRoomAndTheTokensPublicPart_UntilNoServerHasThatSession', async () => {
    env.room = 'hall';
    env.token = '0123456789abcdef'.repeat(4);
    env.socket.accept();
    env.socket.drop(1006);
    env.pass(500);
    const announcing = 'ws://host/rooms/ws?room=hall&resume=0123456789abcdef';
    expect(env.socket.url).toBe(announcing);
    env.refusal = { reason: 'full', closeCode: 4029, retryAfterMs: 60_000 };
    env.socket.drop(1006);
    await Promise.resolve();
    expect(env.asked).toEqual([announcing]);
    // At once, as a new one.
    expect(env.socket.url).toBe('ws://host/rooms/ws?room=hall');
    env.socket.accept();
    expect(env.socket.sent[0]?.body).toMatchObject({ value: { resumeToken: env.token } });
  });

  it('Close_With4011_ComesBackWhenSomebodyDoes', () => {
    env.socket.accept();
    env.socket.drop(4011);
    expect(links.at(-1)).toMatchObject({ phase: 'refused' });
    env.pass(60_000);
    expect(env.sockets.length).toBe(1);
    connection.wake();
    expect(env.sockets.length).toBe(2);
    connection.wake();
    expect(env.sockets.length).toBe(2);
  });

  it('Sleep_WhileTheSocketDied_IsOverWithinASecond', () => {
    env.socket.accept();
    env.pass(12_000);
    env.socket.say({ case: 'pong', value: {} });
    const first = env.socket;
    env.sleep(3 * 3_600_000);
    env.pass(5_000 + 1_000); // the timer that was under way, and the second
    expect(first.closedByPage).toBe(true);
    expect(env.sockets.length).toBe(2);
    expect(phases()).not.toContain('waiting');
  });

  it('Sleep_WhileTheSocketLived_KeepsIt', () => {
    env.socket.accept();
    env.sleep(3_600_000);
    env.pass(5_100);
    env.socket.say({ case: 'pong', value: {} });
    env.pass(60_000 - 50_000);
    expect(env.sockets.length).toBe(1);
    expect(env.socket.said).toEqual(['hello', 'ping', 'ping']);
  });

  it('TimersOfAHiddenPage_OnceAMinute_AreNotSilence', () => {
    env.socket.accept();
    for (let minute = 0; minute < 10; minute += 1) {
      env.throttle(60_000);
      env.socket.say({ case: 'pong', value: {} });
    }
    expect(env.sockets.length).toBe(1);
    expect(env.socket.closedByPage).toBe(false);
  });

  it('Back_WhileWaiting_TriesAtOnce', () => {
    for (let i = 0; i < 6; i += 1) {
      env.socket.drop(1006);
      env.pass(20_000);
    }
    env.socket.drop(1006);
    const count = env.sockets.length;
    connection.back();
    expect(env.sockets.length).toBe(count + 1);
    env.pass(100);
    connection.back(); // it is under way
    expect(env.sockets.length).toBe(count + 1);
  });

  it('Back_AfterTheWayWasLost_OpensAnother_AndWhereItIsThere_Stays', () => {
    env.socket.accept();
    env.pass(1_000);
    connection.back();
    env.socket.say({ case: 'pong', value: {} });
    env.pass(1_000);
    expect(env.sockets.length).toBe(1);
    connection.back();
    env.pass(1_000);
    expect(env.sockets.length).toBe(2);
  });

  it.each([1008, 4009])('Back_AfterClose%i_DoesNotTryAgain', (code) => {
    env.socket.accept();
    env.socket.drop(code);
    connection.back();
    expect(env.sockets.length).toBe(1);
  });
});
