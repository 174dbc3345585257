// Shows the newest picture from the camera of now until the server's own picture of that camera is
// here: camera input does not wait for the server. A view that somebody else steers moves evenly from
// picture to picture. While the camera rests, and where a picture has no depth, the picture itself
// shows.

import type { Size } from '../core/size';
import type { FrameHeader, PictureCamera } from '../gen/froxel/v1/server_pb';
import { toVec, type CameraSettings } from '../settings/settings';
import { verticesAlong, type DepthMesh } from './depth_mesh';
import { Glide } from './glide';
import { warpCamera, warpCameraOf, warped, warpMatrix, type WarpCamera } from './warp_matrix';
import type { Surface } from './warp_surface';

export interface Wanted extends CameraSettings {
  readonly width: number;
  readonly height: number;
}

export interface ReprojectionEnvironment {
  readonly surface: Surface;
  /** What the viewer wants to see now; null: what somebody else wants. */
  readonly wanted: () => Wanted | null;
  readonly nextFrame: (action: (nowMs: number) => void) => void;
  readonly nowMs: () => number;
}

interface Shown {
  readonly bitmap: ImageBitmap;
  readonly camera: WarpCamera;
  readonly size: Size;
  readonly mesh: DepthMesh;
  uploaded: boolean;
}

interface View {
  readonly camera: WarpCamera;
  readonly size: Size;
}

/** A shorter way of any pixel is not seen: the picture shows as it is, to the bit. */
const kStillPx = 0.05;
/** Of the view that the picture does not have. Beyond, another picture is better waited for. */
const kMostOutside = 0.6;
const kProbes = 7; // across and down the view
/** The server has no more pictures on their way than it has credit for: eight, and one that waits. */
const kMostMeshes = 16;

export class Reprojection {
  private meshes: DepthMesh[] = []; // of the picture that is shown and of those on their way
  private shown: Shown | null = null; // null: it cannot be shown from another camera
  private active = true;
  private pending = false;
  private drawnFor: readonly [Shown | null, Wanted | WarpCamera | null] = [null, null];
  private readonly glide = new Glide();

  constructor(private readonly env: ReprojectionEnvironment) {}

  /** Of pictures that come. */
  setMesh(mesh: DepthMesh): void {
    this.meshes.push(mesh);
    if (this.meshes.length > kMostMeshes) this.meshes.shift();
  }

  /** The picture was painted; the bitmap is this one's to close. Draws at once. */
  setPicture(bitmap: ImageBitmap, header: FrameHeader): void {
    this.shown?.bitmap.close();
    this.shown = this.shownOf(bitmap, header);
    this.glide.start(this.shown?.camera ?? null, this.env.nowMs());
    if (!this.shown) bitmap.close();
    this.draw();
  }

  /** Draws before the next repaint. */
  cameraMoved(): void {
    if (this.pending || !this.shown) return;
    this.pending = true;
    this.env.nextFrame(() => {
      this.pending = false;
      this.draw();
    });
  }

  /** Whether the newest picture is shown from the camera of now. */
  get follows(): boolean {
    return this.active && this.shown !== null && this.env.wanted()?.orthographic === false;
  }

  /** False: pictures show as they come. */
  setActive(active: boolean): void {
    this.active = active;
    this.drawnFor = [null, null];
    this.draw();
  }

  /** What comes next is of another session or scene. */
  restart(): void {
    this.shown?.bitmap.close();
    this.shown = null;
    this.meshes = [];
    this.glide.start(null, this.env.nowMs());
    this.env.surface.show(false);
  }

  private shownOf(bitmap: ImageBitmap, header: FrameHeader): Shown | null {
    const { width, height, depthMesh, pictureCamera } = header;
    const mesh = this.meshes.find(({ number }) => number === depthMesh);
    if (!pictureCamera || !mesh) return null;
    this.meshes = this.meshes.filter(({ number }) => number >= depthMesh);
    const { columns, rows, cellPx } = mesh;
    if (columns !== verticesAlong(width, cellPx) || rows !== verticesAlong(height, cellPx)) return null;
    const camera = cameraOfPicture(pictureCamera);
    return camera && { bitmap, camera, size: { width, height }, mesh, uploaded: false };
  }

  private glidingView(): View | null {
    const camera = this.glide.at(this.env.nowMs());
    return camera && this.shown && { camera, size: this.shown.size };
  }

  private draw(): void {
    const { surface } = this.env;
    const { shown } = this;
    const wanted = this.env.wanted();
    const view = wanted ? viewOf(wanted) : this.glidingView();
    const of = wanted ?? view?.camera ?? null; // the same one while nothing changes
    if (this.drawnFor[0] === shown && this.drawnFor[1] === of) return;
    this.drawnFor = [shown, of];
    if (!this.active || !shown || !view || !hasShapeOf(shown.size, view.size)) {
      surface.show(false);
      return;
    }
    if (view.camera !== shown.camera && !wanted) this.cameraMoved(); // on its way
    const aspect = view.size.width / view.size.height;
    const { nearestPerM: nearest, medianPerM } = shown.mesh;
    const matrix = warpMatrix(shown.camera, view.camera, aspect, nearest);
    if (isStill(matrix, view.size, nearest)) {
      surface.show(false);
      return;
    }
    if (outsideShare(warpMatrix(view.camera, shown.camera, aspect, nearest), medianPerM) > kMostOutside) {
      if (!shown.uploaded || !wanted) surface.show(false); // newer than what was warped
      return;
    }
    if (!shown.uploaded) {
      shown.uploaded = true;
      surface.setPicture(shown.bitmap);
      surface.setMesh(shown.mesh);
    }
    surface.draw(matrix, view.size);
    surface.show(true);
  }
}

function viewOf(wanted: Wanted): View | null {
  const camera = warpCameraOf(wanted);
  return camera && { camera, size: wanted };
}

/** Null: one of its numbers is none. */
export function cameraOfPicture(camera: PictureCamera): WarpCamera | null {
  const { eye, right, up, halfHeight, lensShiftX, lensShiftY } = camera;
  const made = warpCamera({ eye: toVec(eye), right: toVec(right), up: toVec(up), halfHeight, lensShiftX, lensShiftY });
  const numbers = [made.eye, made.right, made.up].flatMap(({ x, y, z }) => [x, y, z]);
  const usable = [...numbers, halfHeight, lensShiftX, lensShiftY].every(Number.isFinite) && halfHeight > 0;
  return usable ? made : null;
}

/** Whether a picture, which may be a scaled one, is of that size. */
function hasShapeOf(picture: Size, wanted: Size): boolean {
  const scale = picture.width / wanted.width;
  return Math.abs(picture.height - wanted.height * scale) <= 1;
}

const kEnds: readonly number[] = [-1, 0, 1];

/** Whether nothing would be seen to move, however near it is. */
function isStill(matrix: Float32Array, { width, height }: Size, nearestPerM: number): boolean {
  return kEnds.every((x) =>
    kEnds.every((y) =>
      [0, nearestPerM].every((w) => {
        const at = warped(matrix, x, y, w);
        return at !== null && Math.hypot((at.x - x) * width, (at.y - y) * height) / 2 < kStillPx;
      }),
    ),
  );
}

/** Of a view, by where the picture has what is as far away as most of it. */
function outsideShare(pictureFromView: Float32Array, perM: number): number {
  let outside = 0;
  for (let i = 0; i < kProbes * kProbes; i += 1) {
    const x = (2 * (i % kProbes)) / (kProbes - 1) - 1;
    const y = (2 * Math.floor(i / kProbes)) / (kProbes - 1) - 1;
    const at = warped(pictureFromView, x, y, perM);
    outside += at && Math.abs(at.x) <= 1 && Math.abs(at.y) <= 1 ? 0 : 1;
  }
  return outside / (kProbes * kProbes);
}
