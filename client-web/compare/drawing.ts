// One picture by three.js, in a browser. Where three.js would draw otherwise than glTF asks or than
// froxel does by a setting, the setting is chosen so that both do the same.

import {
  AnimationMixer,
  Color,
  EquirectangularReflectionMapping,
  type Light,
  NeutralToneMapping,
  PerspectiveCamera,
  PointLight,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';
import { DRACOLoader } from 'three/examples/jsm/loaders/DRACOLoader.js';
import { EXRLoader } from 'three/examples/jsm/loaders/EXRLoader.js';
import { type GLTF, GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { KTX2Loader } from 'three/examples/jsm/loaders/KTX2Loader.js';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';
import { EffectComposer } from 'three/examples/jsm/postprocessing/EffectComposer.js';
import { OutputPass } from 'three/examples/jsm/postprocessing/OutputPass.js';
import { RenderPass } from 'three/examples/jsm/postprocessing/RenderPass.js';

import type { Vec } from '../src/core/vec3';
import type { Lamp, Light as Lighting, Size, View } from './view';

export interface Task {
  readonly url: string; // of the file
  readonly decoders: string; // URL of three.js' folder of them
  readonly size: Size;
  readonly view: View;
  readonly near: number; // m
  readonly far: number;
  readonly ownLights: boolean;
  readonly light: Lighting;
  readonly environment: string | null; // URL of a panorama, EXR
}

const kBackground = new Color(0.01, 0.013, 0.02); // linear, before the tone map

const vector = ({ x, y, z }: Vec): Vector3 => new Vector3(x, y, z);

function load(task: Task, renderer: WebGLRenderer): Promise<GLTF> {
  const loader = new GLTFLoader();
  loader.setDRACOLoader(new DRACOLoader().setDecoderPath(`${task.decoders}/draco/gltf/`));
  loader.setKTX2Loader(new KTX2Loader().setTranscoderPath(`${task.decoders}/basis/`).detectSupport(renderer));
  loader.setMeshoptDecoder(MeshoptDecoder);
  return loader.loadAsync(task.url);
}

/** froxel shows a file as its first animation begins. */
function pose({ scene, animations }: GLTF): void {
  const [first] = animations;
  if (!first) return;
  const mixer = new AnimationMixer(scene);
  mixer.clipAction(first).play();
  mixer.update(0);
}

function putOutLights({ scene }: GLTF): void {
  const lights: Light[] = [];
  scene.traverse((node) => void ((node as Partial<Light>).isLight && lights.push(node as Light)));
  for (const light of lights) light.removeFromParent();
}

/** Inverse square, and the same window at its end as froxel's. */
function lampOf({ position, color, intensity, radiusM }: Lamp): PointLight {
  const light = new PointLight(new Color(color.x, color.y, color.z), intensity, radiusM, 2);
  light.position.copy(vector(position));
  return light;
}

function cameraOf({ size, view, near, far }: Task): PerspectiveCamera {
  const camera = new PerspectiveCamera(view.fovDeg, size.width / size.height, near, far);
  camera.position.copy(vector(view.eye));
  camera.lookAt(vector(view.target));
  return camera;
}

/** A PNG file as a data: URL. */
export async function draw(task: Task): Promise<string> {
  const renderer = new WebGLRenderer({ antialias: false });
  renderer.setPixelRatio(1);
  renderer.setSize(task.size.width, task.size.height);
  renderer.toneMapping = NeutralToneMapping;
  renderer.toneMappingExposure = task.light.exposure;
  const gltf = await load(task, renderer);
  if (!task.ownLights) putOutLights(gltf);
  pose(gltf);
  const scene = new Scene();
  // Which three.js exposes.
  scene.background = kBackground.clone().multiplyScalar(1 / task.light.exposure);
  scene.add(gltf.scene, ...task.light.lamps.map(lampOf));
  if (task.environment !== null) {
    const panorama = await new EXRLoader().loadAsync(task.environment);
    panorama.mapping = EquirectangularReflectionMapping;
    scene.environment = panorama;
  }
  // Straight to the canvas three.js would blend what the tone map and sRGB have made of surfaces.
  const composer = new EffectComposer(renderer);
  composer.addPass(new RenderPass(scene, cameraOf(task)));
  composer.addPass(new OutputPass());
  composer.render();
  return renderer.domElement.toDataURL('image/png');
}
