// SPDX-License-Identifier: BSL-1.0
// Builds the page into a folder: one module with what it needs of three.js, and the files beside it.
//   node build.mjs FOLDER                   for sinew serve
//   node build.mjs FOLDER --engine MODULES  with Sinew as WebAssembly, so that it runs without a server
// The program esbuild and three.js are those of Debian's packages esbuild and libjs-three.
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { gzipSync } from 'node:zlib';

const { values: options, positionals } = parseArgs({ allowPositionals: true, options: { engine: { type: 'string' } } });
const here = dirname(fileURLToPath(import.meta.url));
const folder = resolve(positionals[0] ?? `${here}/dist`);
const engine = options.engine && resolve(options.engine);
const three = '/usr/share/javascript/three/three.module.js';
const modules = ['sinew', 'scenes']; // typed scenes, and what reads scene files
process.chdir(here);

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const bundle = (...files) =>
  execFileSync(
    'esbuild',
    [...files, `--outdir=${folder}`, `--alias:three=${three}`, '--entry-names=[name]', '--bundle', '--minify', '--format=esm', '--target=es2022', '--legal-comments=none', '--log-level=warning'],
    { stdio: 'inherit' },
  );
bundle('src/main.js');
for (const file of ['index.html', 'style.css', 'icon.svg']) copyFileSync(file, `${folder}/${file}`);
const [, revision] = readFileSync(three, 'utf8').match(/REVISION = '(\d+)'/);
const licences = [
  ['Sinew', readFileSync('../LICENSE', 'utf8')],
  [`three.js ${revision}`, readFileSync('/usr/share/doc/libjs-three/copyright', 'utf8')],
];
if (engine) {
  bundle('src/worker.js', ...modules.map((name) => `${engine}/${name}.js`));
  // packed, since not every server packs what it sends
  for (const name of modules) writeFileSync(`${folder}/${name}.bin`, gzipSync(readFileSync(`${engine}/${name}.wasm`), { level: 9 }));
  writeFileSync(`${folder}/engine.json`, JSON.stringify({ engine: 'worker', scenes: ['liver', 'vitrectomy'] }));
  licences.push(['In sinew.bin and scenes.bin', readFileSync('engine/licences.txt', 'utf8')]);
}
writeFileSync(`${folder}/licences.txt`, licences.map(([name, text]) => `${name}\n\n${text}`).join('\n\n'));
let size = 0;
for (const file of readdirSync(folder)) size += statSync(`${folder}/${file}`).size;
console.log(`${folder}: ${(size / 1e6).toFixed(2)} MB`);
