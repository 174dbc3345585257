// Puts together what shows the picture from the camera of now.

import type { FrameHeader } from './gen/froxel/v1/server_pb';
import type { CodedDepth } from './protocol/framing';
import { decodeDepthMesh, DepthMeshError } from './warp/depth_mesh';
import { Reprojection, type ReprojectionEnvironment } from './warp/reprojection';
import { WarpSurface } from './warp/warp_surface';

export interface Warp {
  setDepth(depth: CodedDepth): void;
  /** See Reprojection. */
  setPicture(bitmap: ImageBitmap, header: FrameHeader): void;
  cameraMoved(): void;
  restart(): void;
}

export interface WarpEnvironment extends Omit<ReprojectionEnvironment, 'surface'> {
  readonly problem: (text: string) => void;
}

/** Throws where the browser has no WebGL2. */
export function makeWarp(canvas: HTMLCanvasElement, env: WarpEnvironment): Warp {
  const surface = WarpSurface.on(canvas);
  if (!surface) throw new Error('no WebGL2');
  const reprojection = new Reprojection({ surface, wanted: env.wanted, nextFrame: env.nextFrame });
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
  };
}
