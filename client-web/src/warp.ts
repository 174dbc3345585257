// Puts together what shows the picture from the camera of now.

import type { FrameHeader } from './gen/froxel/v1/server_pb';
import type { CodedDepth } from './protocol/framing';
import type { CameraSettings } from './settings/settings';
import type { InputToPicture } from './stats/stats';
import { AskedCamera } from './warp/asked_camera';
import { decodeDepthMesh, DepthMeshError } from './warp/depth_mesh';
import { DrawCost } from './warp/draw_cost';
import { Freshness } from './warp/freshness';
import { Reprojection, type ReprojectionEnvironment } from './warp/reprojection';
import { WarpSurface, type Surface } from './warp/warp_surface';

export interface Warp {
  setDepth(depth: CodedDepth): void;
  /** See Reprojection. */
  setPicture(bitmap: ImageBitmap, header: FrameHeader): void;
  cameraMoved(): void;
  restart(): void;
  /** From input to picture, of late; null: unknown. */
  noteLatency(latency: InputToPicture | null): void;
  /** What to ask the server for while the view is `now`. */
  askedCamera<Camera extends CameraSettings>(now: Camera, nowMs: number): Camera;
  /** Whether depth is wanted. */
  readonly wantsDepth: boolean;
  /** For the viewer: when a moved camera shows. */
  readonly text: string;
}

export interface WarpEnvironment extends Omit<ReprojectionEnvironment, 'surface'> {
  readonly problem: (text: string) => void;
  /** Warp.wantsDepth is another one. */
  readonly wishChanged: () => void;
}

/** Throws where the browser has no WebGL2. */
export function makeWarp(canvas: HTMLCanvasElement, env: WarpEnvironment): Warp {
  let lost = false;
  const surface = WarpSurface.on(canvas, () => {
    lost = true;
    follow();
  });
  if (!surface) throw new Error('no WebGL2');
  const freshness = new Freshness();
  const asked = new AskedCamera();
  let leadMs = 0; // how late pictures are
  const nextFrame: WarpEnvironment['nextFrame'] = (action) =>
    env.nextFrame((nowMs) => {
      freshness.noteFrame(nowMs);
      action(nowMs);
    });
  const cost = new DrawCost();
  const timed: Surface = {
    setPicture: (picture) => surface.setPicture(picture),
    setMesh: (mesh) => surface.setMesh(mesh),
    show: (visible) => surface.show(visible),
    draw: (matrix, size) => {
      cost.draw(() => surface.draw(matrix, size), () => surface.finish(), env.nowMs);
      if (cost.slowMs !== null) queueMicrotask(follow);
    },
  };
  const reprojection = new Reprojection({ ...env, surface: timed, nextFrame });
  const isWanted = (): boolean => !lost && !freshness.fresh && cost.slowMs === null;
  const follow = (): void => {
    reprojection.setActive(isWanted());
    env.wishChanged();
  };
  return {
    setDepth: ({ header, bytes }) => {
      try {
        reprojection.setMesh(decodeDepthMesh(header, bytes));
      } catch (error) {
        if (!(error instanceof DepthMeshError)) throw error;
        env.problem(error.message);
      }
    },
    setPicture: (bitmap, header) => reprojection.setPicture(bitmap, header),
    cameraMoved: () => reprojection.cameraMoved(),
    restart: () => reprojection.restart(),
    noteLatency: (latency) => {
      leadMs = latency?.p50Ms ?? leadMs;
      if (freshness.noteLatency(latency?.p95Ms ?? null)) follow();
    },
    askedCamera: (now, nowMs) => (reprojection.follows ? asked.of(now, nowMs, leadMs) : now),
    get wantsDepth() {
      return isWanted();
    },
    get text() {
      if (lost) return 'late (WebGL2 lost)';
      if (cost.slowMs !== null) return `late (WebGL2: ${cost.slowMs.toFixed(0)} ms)`;
      return freshness.fresh ? 'at once (fresh)' : 'at once';
    },
  };
}
