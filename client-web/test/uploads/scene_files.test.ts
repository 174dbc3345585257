import { describe, expect, it } from 'vitest';

import type { BroughtFile } from '../../src/uploads/dropped';
import { scenesIn, sceneFiles } from '../../src/uploads/scene_files';

const file = (path: string, text = ''): BroughtFile => ({ path, blob: new Blob([text]) });
const gltf = (...uris: string[]): string =>
  JSON.stringify({ buffers: uris.slice(0, 1).map((uri) => ({ uri })), images: uris.slice(1).map((uri) => ({ uri })) });

function glb(json: string): Blob {
  const text = new TextEncoder().encode(json);
  const header = new DataView(new ArrayBuffer(20));
  header.setUint32(0, 0x46546c67, true);
  header.setUint32(4, 2, true);
  header.setUint32(12, text.length, true);
  return new Blob([header.buffer, text, 'binary']);
}

describe('sceneFiles', () => {
  it('HasWhatTheSceneNames_AndNothingBesides', async () => {
    const scene = file('fox/fox.gltf', gltf('fox.bin', './textures/a%20b.png', 'data:image/png;base64,AA', 'textures/a%20b.png'));
    const all = [scene, file('fox/fox.bin'), file('fox/textures/a b.png'), file('fox/notes.txt'), file('other.bin')];
    const { files, missing } = await sceneFiles(scene, all);
    expect(files.map(({ path }) => path)).toEqual(['fox.gltf', 'fox.bin', 'textures/a b.png']);
    expect(missing).toEqual([]);
  });

  it('NamesWhatIsMissing', async () => {
    const scene = file('fox.gltf', gltf('fox.bin', '../up.png', '100%.png'));
    const { files, missing } = await sceneFiles(scene, [scene]);
    expect(files.map(({ path }) => path)).toEqual(['fox.gltf']);
    expect(missing).toEqual(['fox.bin', '../up.png', '100%.png']);
  });

  it('GlbThatNamesFiles_NeedsThem', async () => {
    const scene = { path: 'a.glb', blob: glb(gltf('a.bin')) };
    expect((await sceneFiles(scene, [scene])).missing).toEqual(['a.bin']);
    expect((await sceneFiles(scene, [scene, file('a.bin')])).missing).toEqual([]);
  });

  it.each(['', '{', 'null', '[]', '{"buffers":{}}', '{"images":[{"uri":1},null]}', 'glTF'])('OfNoScene_TheServerJudges (%s)', async (text) => {
    const scene = file('a.gltf', text);
    expect((await sceneFiles(scene, [scene])).missing).toEqual([]);
  });

  it('ObjNeedsItsMaterials_AndTheImagesOfThose', async () => {
    const scene = file('car/car.obj', '# a car\nmtllib ./car.mtl\r\nv 0 0 0\n  mtllib gone.mtl\n');
    const mtl = file('car/car.mtl', 'newmtl a\nmap_Kd -s 2 2 -clamp on C:\\tex\\red paint.png\r\nnorm tex\\n.png\nmap_Ks not_read.png\n');
    const all = [scene, mtl, file('car/red paint.png')];
    const { files, missing } = await sceneFiles(scene, all);
    expect(files.map(({ path }) => path)).toEqual(['car.obj', 'car.mtl', 'red paint.png']);
    expect(missing).toEqual(['tex/n.png', 'gone.mtl']);
  });

  it('PlyNeedsItsTexture_AndOthersNothing', async () => {
    const ply = file('a.ply', 'ply\nformat ascii 1.0\ncomment TextureFile skin.jpg\nend_header\n');
    expect((await sceneFiles(ply, [ply])).missing).toEqual(['skin.jpg']);
    const stl = file('a.stl', 'solid comment TextureFile skin.jpg');
    expect(await sceneFiles(stl, [stl])).toEqual({ files: [stl], missing: [] });
  });

  it('Names_AreTheSame_HoweverTheirAccentsAreWritten', async () => {
    const scene = file('a.gltf', gltf('\u00e4.bin'));
    expect((await sceneFiles(scene, [scene, file('a\u0308.bin')])).missing).toEqual([]);
  });
});

it('scenesIn_IsByTheEnding', () => {
  const paths = ['a.GLB', 'b/c.gltf', 'd.vrm', 'e.bin', 'glb', 'f.obj', 'f.mtl', 'g.ply', 'h.STL', 'i.3mf'];
  expect(scenesIn(paths.map((path) => file(path))).map(({ path }) => path)).toEqual(['a.GLB', 'b/c.gltf', 'd.vrm', 'f.obj', 'g.ply', 'h.STL', 'i.3mf']);
});
