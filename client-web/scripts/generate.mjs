// Generates src/gen from the schema in ../protocol with the system's protoc.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readdirSync, rmSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const client = resolve(fileURLToPath(import.meta.url), '../..');
const schema = resolve(client, '../protocol');
const out = join(client, 'src/gen');

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const files = readdirSync(join(schema, 'froxel/v1')).filter((name) => name.endsWith('.proto'));
try {
  execFileSync(
    'protoc',
    [
      `-I${schema}`,
      `--plugin=protoc-gen-es=${join(client, 'node_modules/.bin/protoc-gen-es')}`,
      `--es_out=${out}`,
      '--es_opt=target=ts',
      ...files.map((name) => join(schema, 'froxel/v1', name)),
    ],
    { stdio: 'inherit' },
  );
} catch (error) {
  const missing = error.code === 'ENOENT';
  console.error(missing ? 'generate: protoc not found; install protobuf-compiler' : error.message);
  process.exit(1);
}
