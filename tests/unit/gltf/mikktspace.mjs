// Holds the tangents of the tests' meshes against those of MikkTSpace's author: 77 means that the
// package is not installed.
// Usage: node mikktspace.mjs TEST_EXECUTABLE PACKAGE FOLDER
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const [testExecutable, oraclePackage, folder] = process.argv.slice(2);
if (!existsSync(oraclePackage)) {
  console.log(`skipped: ${oraclePackage} is not installed (npm ci in client-web)`);
  process.exit(77);
}
const { generateTangents } = createRequire(import.meta.url)(oraclePackage);

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const writing = spawnSync(testExecutable, ['--gtest_filter=TangentSpace.Meshes_ForTheOracle'], {
  env: { ...process.env, FROXEL_TANGENTS_FOLDER: folder },
  encoding: 'utf8',
});
if (writing.status !== 0) {
  console.log(writing.stdout);
  process.exit(1);
}

const kLeastCosine = 0.9999;
// Triangles of one corner whose tangents are exactly opposite, which it alone keeps apart: few.
const kMostWrong = 0.001;
let corners = 0;
let undecided = 0;
let wrong = 0;
for (const mesh of JSON.parse(readFileSync(join(folder, 'meshes.json'), 'utf8'))) {
  const floats = (name) => new Float32Array(mesh[name]);
  const wanted = generateTangents(floats('positions'), floats('normals'), floats('uv'));
  for (let i = 0; i < wanted.length; i += 4) {
    corners += 1;
    // Where no triangle says anything it gives this, on the plane or not.
    const [x, y, z, w] = wanted.slice(i, i + 4);
    if (x === 1 && y === 0 && z === 0) {
      undecided += 1;
      continue;
    }
    const [tx, ty, tz, tw] = mesh.tangents.slice(i, i + 4);
    const cosine = (x * tx + y * ty + z * tz) / Math.hypot(x, y, z);
    // It has the bitangent along rising v, glTF against it.
    if (cosine < kLeastCosine || tw !== -w) {
      if (wrong < 10) {
        console.log(`${mesh.name}, corner ${i / 4}: ${mesh.tangents.slice(i, i + 4)}; MikkTSpace has ${[x, y, z, -w]}`);
      }
      wrong += 1;
    }
  }
}
console.log(`${corners} corners, ${undecided} of which nothing decides, ${wrong} wrong`);
process.exit(wrong > corners * kMostWrong || undecided > corners / 2 ? 1 : 0);
