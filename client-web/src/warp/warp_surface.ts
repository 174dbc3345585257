// A canvas over the picture's that shows it from another camera, by WebGL2: the picture on a mesh of
// its depth.

import type { Size } from '../core/size';
import type { DepthMesh } from './depth_mesh';

/** The part of WarpSurface that Reprojection uses. */
export interface Surface {
  setPicture(picture: ImageBitmap): void;
  setMesh(mesh: DepthMesh): void;
  /** Of the picture and mesh that were set last, in a canvas of `size` pixels. */
  draw(matrix: Float32Array<ArrayBuffer>, size: Size): void;
  /** False: what is beneath shows. */
  show(visible: boolean): void;
}

/**
 * A vertex for each of the mesh and a ring of them around it, a picture's side away, where the edge
 * goes on. `at` counts those of the mesh.
 */
const kVertexShader = `#version 300 es
uniform mat4 warp;
uniform ivec2 grid;
uniform vec2 size;
uniform float per_step;
uniform float cell;
in float step_number;
out vec2 share;
void main() {
  ivec2 at = ivec2(gl_VertexID % (grid.x + 2), gl_VertexID / (grid.x + 2)) - 1;
  vec2 pixel = min(vec2(clamp(at, ivec2(0), grid - 1)) * cell, size - 1.0) + 0.5;
  pixel += size * (vec2(equal(at, grid)) - vec2(lessThan(at, ivec2(0))));
  share = pixel / size;
  gl_Position = warp * vec4(share.x * 2.0 - 1.0, 1.0 - share.y * 2.0, step_number * per_step, 1.0);
}`;

const kFragmentShader = `#version 300 es
precision highp float;
uniform sampler2D picture;
in vec2 share;
out vec4 color;
void main() { color = vec4(texture(picture, share).rgb, 1.0); }`;

/** The mesh with the ring: each vertex of the ring has the depth of the edge's. */
export function withRing({ columns, rows, steps }: DepthMesh): Uint16Array<ArrayBuffer> {
  const wide = columns + 2;
  const ringed = new Uint16Array(wide * (rows + 2));
  for (let y = 0; y < rows + 2; y += 1) {
    const from = Math.max(0, Math.min(rows - 1, y - 1)) * columns;
    const to = y * wide;
    ringed.set(steps.subarray(from, from + columns), to + 1);
    ringed[to] = steps[from] ?? 0;
    ringed[to + wide - 1] = steps[from + columns - 1] ?? 0;
  }
  return ringed;
}

/** Two triangles a cell of a lattice of vertices. */
export function triangles(columns: number, rows: number): Uint32Array<ArrayBuffer> {
  const indices = new Uint32Array((columns - 1) * (rows - 1) * 6);
  let at = 0;
  for (let y = 0; y + 1 < rows; y += 1) {
    for (let x = 0; x + 1 < columns; x += 1) {
      const a = y * columns + x;
      const below = a + columns;
      indices.set([a, below, a + 1, a + 1, below, below + 1], at);
      at += 6;
    }
  }
  return indices;
}

interface Made {
  readonly gl: WebGL2RenderingContext;
  readonly uniform: (name: string) => WebGLUniformLocation | null;
}

export class WarpSurface implements Surface {
  private mesh: Size | null = null; // with the ring
  private picture: Size | null = null;
  private indexCount = 0;

  /** Null: this browser has no WebGL2 that would draw it. `lost`: the device that it draws on is gone. */
  static on(canvas: HTMLCanvasElement, lost: () => void): WarpSurface | null {
    const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, powerPreference: 'high-performance' });
    const program = gl && programOf(gl);
    if (!program) return null;
    gl.useProgram(program);
    canvas.addEventListener('webglcontextlost', lost, { once: true });
    return new WarpSurface(canvas, { gl, uniform: (name) => gl.getUniformLocation(program, name) });
  }

  private constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly made: Made,
  ) {
    const { gl } = made;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.enableVertexAttribArray(0); // the only one
    gl.vertexAttribPointer(0, 1, gl.UNSIGNED_SHORT, false, 0, 0);
  }

  setPicture(picture: ImageBitmap): void {
    const { gl, uniform } = this.made;
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, picture);
    this.picture = { width: picture.width, height: picture.height };
    gl.uniform2f(uniform('size'), picture.width, picture.height);
  }

  setMesh(mesh: DepthMesh): void {
    const { gl, uniform } = this.made;
    gl.bufferData(gl.ARRAY_BUFFER, withRing(mesh), gl.STREAM_DRAW);
    gl.uniform1f(uniform('per_step'), mesh.perStep);
    gl.uniform1f(uniform('cell'), mesh.cellPx);
    const [width, height] = [mesh.columns + 2, mesh.rows + 2];
    if (this.mesh?.width === width && this.mesh.height === height) return;
    this.mesh = { width, height };
    const indices = triangles(width, height);
    this.indexCount = indices.length;
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    gl.uniform2i(uniform('grid'), mesh.columns, mesh.rows);
  }

  draw(matrix: Float32Array<ArrayBuffer>, size: Size): void {
    if (!this.mesh || !this.picture) return;
    const { gl, uniform } = this.made;
    const { canvas } = this;
    if (canvas.width !== size.width || canvas.height !== size.height) {
      canvas.width = size.width;
      canvas.height = size.height;
    }
    gl.viewport(0, 0, size.width, size.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(uniform('warp'), false, matrix);
    gl.drawElements(gl.TRIANGLES, this.indexCount, gl.UNSIGNED_INT, 0);
  }

  /** Waits until all is drawn. */
  finish(): void {
    const { gl } = this.made;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  show(visible: boolean): void {
    this.canvas.hidden = !visible;
  }
}

function programOf(gl: WebGL2RenderingContext): WebGLProgram | null {
  const program = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, kVertexShader],
    [gl.FRAGMENT_SHADER, kFragmentShader],
  ] as const) {
    const shader = gl.createShader(type);
    if (!shader) return null; // the context is lost
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, 'step_number');
  gl.linkProgram(program);
  return gl.getProgramParameter(program, gl.LINK_STATUS) === true ? program : null;
}
