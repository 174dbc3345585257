// Which parts of a picture another one shows, by the depth of both.

import type { FrameHeader } from '../src/gen/froxel/v1/server_pb';
import type { CodedDepth } from '../src/protocol/framing';
import { decodeDepthMesh, type DepthMesh } from '../src/warp/depth_mesh';
import { cameraOfPicture } from '../src/warp/reprojection';
import { warped, warpMatrix, type WarpCamera, type Warped } from '../src/warp/warp_matrix';

export interface View {
  readonly mesh: DepthMesh;
  readonly camera: WarpCamera;
  readonly aspect: number;
}

export function viewOf(header: FrameHeader, depths: ReadonlyMap<bigint, CodedDepth>): View {
  const { width, height, depthMesh, pictureCamera } = header;
  const depth = depths.get(depthMesh);
  const camera = pictureCamera && cameraOfPicture(pictureCamera);
  if (!depth || !camera) throw new Error(`frame ${header.frameId} has no depth`);
  return { mesh: decodeDepthMesh(depth.header, depth.bytes), camera, aspect: width / height };
}

/** A surface that is nearer by less than this share is the same one. */
const kSameSurface = 1.05;

/** Of each vertex of `view`, by row: whether the picture of `other` has what is there. */
export function seenVertices(view: View, other: View): boolean[] {
  const { columns, rows, steps, perStep, nearestPerM } = view.mesh;
  const matrix = warpMatrix(view.camera, other.camera, view.aspect, nearestPerM);
  const across = (i: number, count: number): number => -1 + (2 * i) / (count - 1);
  return Array.from(steps, (step, i) => {
    const [x, y, w] = [across(i % columns, columns), -across(Math.floor(i / columns), rows), step * perStep];
    const at = warped(matrix, x, y, w);
    if (!at || Math.abs(at.x) > 1 || Math.abs(at.y) > 1) return false;
    return farthestAt(other.mesh, at) <= kSameSurface * at.w + 2 * other.mesh.perStep;
  });
}

/** The inverse distance of the farthest of the vertices around a place, in 1/m. */
function farthestAt({ columns, rows, steps, perStep }: DepthMesh, { x, y }: Warped): number {
  const column = Math.min(columns - 2, Math.floor(((x + 1) / 2) * (columns - 1)));
  const row = Math.min(rows - 2, Math.floor(((1 - y) / 2) * (rows - 1)));
  const at = (dx: number, dy: number): number => steps[(row + dy) * columns + column + dx] ?? 0;
  return Math.min(at(0, 0), at(1, 0), at(0, 1), at(1, 1)) * perStep;
}
