// SPDX-License-Identifier: BSL-1.0
// Builds the page into web/dist: one module with what it needs of three.js, and the files beside it. With a folder as argument
// it builds the page there, with what is in engine/build: Sinew as WebAssembly, so that it runs without a server.
import { build } from 'esbuild';
import { copyFile, mkdir, readdir, readFile, rm, stat, writeFile } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const folder = resolve(process.argv[2] ?? `${here}/dist`);
process.chdir(here);
const alone = process.argv.length > 2;

await rm(folder, { recursive: true, force: true });
await mkdir(folder, { recursive: true });
await build({
  absWorkingDir: process.cwd(),
  entryPoints: ['src/main.js', ...(alone ? ['src/worker.js'] : [])],
  outdir: folder,
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'none',
  logLevel: 'warning',
});
for (const file of ['index.html', 'style.css', 'icon.svg']) await copyFile(file, `${folder}/${file}`);
const { version } = JSON.parse(await readFile('node_modules/three/package.json', 'utf8'));
const licences = [
  ['Sinew', await readFile('../LICENSE', 'utf8')],
  [`three.js ${version}`, await readFile('node_modules/three/LICENSE', 'utf8')],
];
if (alone) {
  // packed, since not every server packs what it sends
  await writeFile(`${folder}/sinew.bin`, gzipSync(await readFile('engine/build/sinew.wasm'), { level: 9 }));
  await writeFile(`${folder}/engine.json`, JSON.stringify({ engine: 'worker', scenes: ['liver', 'vitrectomy'] }));
  licences.push(['Eigen, JSON for Modern C++ and the libraries of emscripten, in sinew.bin', await readFile('engine/licences.txt', 'utf8')]);
}
await writeFile(`${folder}/licences.txt`, licences.map(([name, text]) => `${name}\n\n${text}`).join('\n\n'));
let size = 0;
for (const file of await readdir(folder)) size += (await stat(`${folder}/${file}`)).size;
console.log(`${folder}: ${(size / 1e6).toFixed(2)} MB`);
