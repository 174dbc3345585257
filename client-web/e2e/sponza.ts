// Views of Sponza in a page, of which the server is held while the camera moves.

import { length, sub, vec, type Vec } from '../src/core/vec3';
import type { FrameHeader } from '../src/gen/froxel/v1/server_pb';
import type { CameraSettings as Camera } from '../src/settings/settings';
import { viewOf, type View } from './seen';
import type { Server } from './server';
import { until, type Viewer } from './viewer';

export const kSizePx = { width: 640, height: 360 };
/** Every pixel as the server has it, so that pictures differ by the warp alone. */
export const kPicture = `#size=${kSizePx.width}x${kSizePx.height}&animate=0&refine=none&adaptive=0&quality=95&chroma=444&lights=500`;
/** A style of the page. */
export const kPictureAlone = 'body > :not(:has(canvas)), :has(> canvas) > :not(canvas) { display: none !important }';

/** Along the nave, and close to pillars and plants at its side. */
export const kUp = vec(0, 1, 0);
const kShape = { up: kUp, fovDeg: 45, orthographic: false, halfHeight: 1, lensShiftX: 0, lensShiftY: 0 };
export const kViews: ReadonlyMap<string, Camera> = new Map([
  ['nave', { eye: vec(-7, 2, 0), target: vec(0, 2, 0), ...kShape }],
  ['side', { eye: vec(-2, 1.6, 2.6), target: vec(3, 1.6, -1.5), ...kShape }],
]);

const text = ({ x, y, z }: Vec): string => [x, y, z].join(',');

function addressOf({ eye, target, fovDeg }: Camera): string {
  return `${kPicture}&eye=${text(eye)}&target=${text(target)}&up=0,1,0&fov_deg=${fovDeg}`;
}

interface Mask {
  readonly png: string; // base64
  readonly seen: boolean[];
  readonly columns: number;
  readonly cell: number; // pixels
}

/** Runs in the page: the picture with the cells of vertices that are not `seen` painted over. */
async function maskInPage({ png, seen, columns, cell }: Mask): Promise<string> {
  const bytes = Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0));
  const picture = await createImageBitmap(new Blob([bytes]));
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  const context = canvas.getContext('2d');
  if (!context) throw new Error('no canvas');
  context.drawImage(picture, 0, 0);
  context.fillStyle = 'gray';
  for (const [i, isSeen] of seen.entries()) {
    if (!isSeen) context.fillRect((i % columns) * cell - cell / 2, Math.floor(i / columns) * cell - cell / 2, cell, cell);
  }
  const masked = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
  return btoa(Array.from(masked, (byte) => String.fromCharCode(byte)).join(''));
}

export class Sponza {
  constructor(
    private readonly viewer: Viewer,
    private readonly server: Server,
  ) {}

  /** Waits until the page shows the server's own picture from there. */
  async arriveAt(pose: Camera): Promise<View> {
    this.server.hold(false);
    await this.goTo(pose);
    const header = await until('a picture from there', () => this.frameFrom(pose));
    await this.viewer.commandsSent();
    await until('the picture itself', async () => !(await this.viewer.page.locator('#warp').isVisible()));
    return viewOf(header, this.viewer.depths);
  }

  /** The page while the server stands still. */
  async warpedTo(pose: Camera): Promise<Buffer> {
    this.server.hold(true);
    await this.goTo(pose);
    await this.viewer.commandsSent();
    const warped = await this.shot();
    this.server.hold(false);
    return warped;
  }

  shot(): Promise<Buffer> {
    return this.viewer.page.screenshot();
  }

  /** The server's still of a pose. */
  async truth(pose: Camera): Promise<Buffer> {
    const answer = await fetch(`${this.server.url}render?format=png&${addressOf(pose).slice(1)}`);
    if (!answer.ok) throw new Error(`render: ${await answer.text()}`);
    return Buffer.from(await answer.arrayBuffer());
  }

  /** `seen`: by vertex of the view's mesh. */
  async masked(png: Buffer, seen: boolean[], { mesh }: View): Promise<Buffer> {
    const mask: Mask = { png: png.toString('base64'), seen, columns: mesh.columns, cell: mesh.cellPx };
    return Buffer.from(await this.viewer.page.evaluate(maskInPage, mask), 'base64');
  }

  /** As a link to that view that somebody opens in the page. */
  private async goTo(pose: Camera): Promise<void> {
    await this.viewer.page.evaluate((to) => {
      location.hash = to;
    }, addressOf(pose));
  }

  private frameFrom({ eye }: Camera): FrameHeader | null {
    const { lastFrame } = this.viewer;
    const at = lastFrame?.pictureCamera?.eye;
    return at && length(sub(eye, vec(at.x, at.y, at.z))) < 1e-6 ? lastFrame : null;
  }
}
