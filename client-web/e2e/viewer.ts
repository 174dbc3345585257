// A page in headless Chromium, with what it says and hears on its WebSocket.

import { mkdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

import { fromBinary } from '@bufbuild/protobuf';
import type { Browser, BrowserContext, BrowserContextOptions, Locator, Page } from 'playwright-core';

import { ClientMessageSchema, type ClientMessage } from '../src/gen/froxel/v1/client_pb';
import { DebugView, Refine, Refinement, type ViewState } from '../src/gen/froxel/v1/common_pb';
import type { FrameHeader, ServerMessage } from '../src/gen/froxel/v1/server_pb';
import { decodeBinary, type CodedDepth } from '../src/protocol/framing';

const kResults = fileURLToPath(new URL('../test-results', import.meta.url));
const kPatienceMs = 240_000;
const kPollMs = 50;

interface SentCounter {
  sentCount?: number;
}

/** Runs in the page, before its own scripts. */
function countSent(): void {
  const counter = globalThis as SentCounter;
  counter.sentCount = 0;
  globalThis.WebSocket = class extends WebSocket {
    override send(message: Parameters<WebSocket['send']>[0]): void {
      counter.sentCount = (counter.sentCount ?? 0) + 1;
      super.send(message);
    }
  };
}

type Nothing = null | undefined | false;

/** Waits until `probe` gives something, and returns it. */
export async function until<T>(
  what: string,
  probe: () => T | Nothing | Promise<T | Nothing>,
): Promise<T> {
  const end = Date.now() + kPatienceMs;
  for (;;) {
    const value = await probe();
    if (value !== null && value !== undefined && value !== false) return value;
    if (Date.now() > end) throw new Error(`waited in vain for: ${what}`);
    await new Promise((wake) => setTimeout(wake, kPollMs));
  }
}

export class Viewer {
  readonly received: ServerMessage[] = [];
  readonly sent: ClientMessage[] = [];
  readonly complaints: string[] = []; // errors on the console, exceptions
  private sentCount = 0; // of any kind, as far as Chromium has told
  frameCount = 0;
  readonly depths = new Map<bigint, CodedDepth>(); // by number
  lastFrame: FrameHeader | null = null;
  connectionCount = 0;

  private constructor(readonly page: Page) {
    page.on('pageerror', (error) => this.complaints.push(error.message));
    page.on('console', (message) => {
      if (message.type() === 'error') this.complaints.push(message.text());
    });
    page.on('websocket', (socket) => {
      this.connectionCount += 1;
      socket.on('framereceived', ({ payload }) => this.heard(payload));
      socket.on('framesent', ({ payload }) => {
        this.sentCount += 1;
        if (typeof payload !== 'string') {
          this.sent.push(fromBinary(ClientMessageSchema, new Uint8Array(payload)));
        }
      });
    });
  }

  static async open(
    browser: Browser,
    url: string,
    options: BrowserContextOptions = {},
  ): Promise<Viewer> {
    return Viewer.in(await browser.newContext({ viewport: { width: 1280, height: 720 }, ...options }), url);
  }

  static async in(context: BrowserContext, url: string): Promise<Viewer> {
    await context.addInitScript(countSent);
    const viewer = new Viewer(await context.newPage());
    await viewer.page.goto(url);
    return viewer;
  }

  close(): Promise<void> {
    return this.page.context().close();
  }

  /** The newest complete state that the server told. */
  get state(): ViewState | undefined {
    for (const { body } of [...this.received].reverse()) {
      if (body.case === 'state' || body.case === 'welcome') return body.value.state;
    }
    return undefined;
  }

  stateWith(what: string, test: (state: ViewState) => boolean): Promise<ViewState> {
    return until(`a state with ${what}`, () => {
      const { state } = this;
      return state && test(state) ? state : null;
    });
  }

  /** Mean and a coarse 16 × 9 copy of the picture, as bytes of R, G and B. */
  async thumbnail(): Promise<number[]> {
    return this.page.evaluate(() => {
      const source = document.querySelector('canvas');
      const small = document.createElement('canvas');
      small.width = 16;
      small.height = 9;
      const context = small.getContext('2d');
      if (!source || !context) return [];
      context.drawImage(source, 0, 0, small.width, small.height);
      const { data } = context.getImageData(0, 0, small.width, small.height);
      return [...data].filter((_, index) => index % 4 !== 3);
    });
  }

  /** The same of the whole page, as it is seen. */
  async pageThumbnail(): Promise<number[]> {
    const png = (await this.page.screenshot()).toString('base64');
    return this.page.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const small = new OffscreenCanvas(64, 36);
      const context = small.getContext('2d');
      if (!context) return [];
      context.drawImage(await createImageBitmap(new Blob([bytes])), 0, 0, small.width, small.height);
      const { data } = context.getImageData(0, 0, small.width, small.height);
      return [...data].filter((_, index) => index % 4 !== 3);
    }, png);
  }

  async picture(): Promise<number[]> {
    return until('a picture that is not black', async () => {
      const pixels = await this.thumbnail();
      return pixels.some((value) => value > 16) ? pixels : null;
    });
  }

  /** Whether no better picture of a view that rests is to come. A busy machine's link is slow, so that pictures give way. */
  private get refined(): boolean {
    const { state, lastFrame } = this;
    if (!state || !lastFrame) return false;
    if (state.lightAnimate && state.lightCount > 0) return true;
    if (state.refine === Refine.NONE) {
      const { refinement, scale, chroma, quality } = lastFrame;
      const asIs = scale === 1 && chroma === state.chroma && (quality === 0 || quality === state.quality);
      return asIs || refinement >= Refinement.SETTLED;
    }
    const single = state.debugView !== DebugView.NONE || state.compare !== '';
    const smooth = single ? Refinement.HIGH : Refinement.SMOOTH;
    const last = state.refine === Refine.HIGH ? smooth : Refinement.LOSSLESS;
    return lastFrame.refinement === last;
  }

  /** Waits until all that was asked for is in the picture, and gives that one's thumbnail. */
  async settled(): Promise<number[]> {
    await this.commandsSent();
    await until('a picture of the newest settings', () => {
      const asked = this.sent.filter(({ body }) => /^(set|select|pick)/.test(body.case ?? '')).at(-1);
      const shown = this.sent.filter(({ body }) => body.case === 'ack').at(-1)?.body;
      const { lastFrame } = this;
      return (
        lastFrame !== null &&
        this.refined &&
        lastFrame.appliedSeq >= (asked?.seq ?? 0n) &&
        shown?.case === 'ack' &&
        shown.value.frameId === lastFrame.frameId
      );
    });
    return this.thumbnail();
  }

  /**
   * Waits until what was chosen has left the page, a camera at the next frame, and Chromium has told of it: it does by
   * another way than it answers by, so on a busy machine later.
   */
  async commandsSent(): Promise<void> {
    const count = await this.page.evaluate(
      () =>
        new Promise<number>((done) => {
          requestAnimationFrame(() =>
            requestAnimationFrame(() => done((globalThis as SentCounter).sentCount ?? 0)),
          );
        }),
    );
    await until('the messages that the page sent', () => this.sentCount >= count);
  }

  /** Waits for a picture that differs from `before` by more than JPEG noise. */
  changed(what: string, before: readonly number[]): Promise<true> {
    return until(`another picture after ${what}`, async () => {
      const now = await this.thumbnail();
      return difference(now, before) > 1 ? true : null;
    });
  }

  control(field: string): Locator {
    return this.page.locator(`#panel [data-field="${field}"]`);
  }

  /** Opens the panel and every folder of it, so that each control can be reached. */
  async openPanel(): Promise<void> {
    if (!(await this.page.locator('#panel').isVisible())) await this.page.locator('#tool-panel').click();
    await this.page.locator('#panel [data-field]').first().waitFor({ state: 'attached' });
    const closed = this.page.locator('#panel .lil-closed > .lil-title:visible');
    while ((await closed.count()) > 0) {
      await closed.first().click();
      await this.page.waitForTimeout(50); // the folder's transition swaps its classes
    }
  }

  /** Bytes of all that the page has fetched, as they came over the wire. */
  fetchedBytes(): Promise<number> {
    return this.page.evaluate(() =>
      [...performance.getEntriesByType('navigation'), ...performance.getEntriesByType('resource')]
        .map((entry) => (entry as PerformanceResourceTiming).encodedBodySize)
        .reduce((sum, bytes) => sum + bytes, 0),
    );
  }

  async openFigures(): Promise<void> {
    if (!(await this.page.locator('#stats-body').isVisible())) await this.page.locator('#stats-head').click();
  }

  async type(field: string, value: number): Promise<void> {
    const input = this.control(field).locator('input:not([type=range])');
    await input.fill(String(value));
    await input.press('Enter');
  }

  choose(field: string, label: string): Promise<string[]> {
    return this.control(field).locator('select').selectOption({ label });
  }

  /** Waits for a banner that says so. */
  told(text: RegExp | string): Promise<true> {
    return until(`a banner with ${String(text)}`, async () => {
      const shown = await this.page.locator('#banner').isVisible();
      const words = (await this.page.locator('#banner').textContent()) ?? '';
      return shown && (typeof text === 'string' ? words.includes(text) : text.test(words)) ? true : null;
    });
  }

  /** A PNG, which is kept among the results, too. */
  screenshot(name: string): Promise<Buffer> {
    mkdirSync(kResults, { recursive: true });
    return this.page.screenshot({ path: `${kResults}/${name}.png` });
  }

  private heard(payload: string | Buffer): void {
    if (typeof payload === 'string') return;
    const decoded = decodeBinary(new Uint8Array(payload).buffer);
    if (decoded.kind === 'message') {
      this.received.push(decoded.message);
      return;
    }
    if (decoded.kind === 'depth') {
      this.depths.set(decoded.depth.header.number, decoded.depth);
      return;
    }
    this.frameCount += 1;
    this.lastFrame = decoded.frame.header;
  }
}

/** Mean absolute difference of two thumbnails, in steps of 8 bits. */
export function difference(a: readonly number[], b: readonly number[]): number {
  return a.reduce((sum, value, i) => sum + Math.abs(value - (b[i] ?? 0)), 0) / a.length;
}
