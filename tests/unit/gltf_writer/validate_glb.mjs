// Lets the writer's tests write their files into a folder and puts each through Khronos' glTF
// validator: an error or an unexpected warning fails, 77 means that the validator is not installed.
// Usage: node validate_glb.mjs TEST_EXECUTABLE VALIDATOR_PACKAGE FOLDER
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const [testExecutable, validatorPackage, folder] = process.argv.slice(2);
if (!existsSync(validatorPackage)) {
  console.log(`skipped: ${validatorPackage} is not installed (npm ci in client-web)`);
  process.exit(77);
}
const validator = createRequire(import.meta.url)(validatorPackage);

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const writing = spawnSync(testExecutable, ['--gtest_filter=GlbWriter.*_Reads*'], {
  env: { ...process.env, FROXEL_GLB_FOLDER: folder },
  encoding: 'utf8',
});
if (writing.status !== 0) {
  console.log(writing.stdout);
  process.exit(1);
}

// The hall leaves its tangent frames to the reader: vertices stay small, and the shader's derivative
// frames need no stream. The validator calls that non-portable, not wrong.
const accepted = new Set(['MESH_PRIMITIVE_GENERATED_TANGENT_SPACE']);

const files = readdirSync(folder).filter((name) => name.endsWith('.glb'));
let problems = files.length === 0 ? 1 : 0;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(join(folder, file))), {
    maxIssues: 0, // all
  });
  const { numErrors, numWarnings, numInfos, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos`);
  const serious = messages.filter(({ severity, code }) => severity <= 1 && !accepted.has(code));
  for (const issue of serious) {
    console.log(`  ${issue.code} ${issue.pointer}: ${issue.message}`);
  }
  problems += serious.length;
}
process.exit(problems === 0 ? 0 : 1);
