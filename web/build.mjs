// SPDX-License-Identifier: BSL-1.0
// Builds the page into web/dist: one module with what it needs of three.js, and the files beside it.
import { build } from 'esbuild';
import { copyFile, mkdir, readFile, writeFile } from 'node:fs/promises';

await mkdir('dist', { recursive: true });
await build({
  entryPoints: ['src/main.js'],
  outdir: 'dist',
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'none',
  logLevel: 'warning',
});
for (const file of ['index.html', 'style.css', 'icon.svg']) await copyFile(file, `dist/${file}`);
const { version } = JSON.parse(await readFile('node_modules/three/package.json', 'utf8'));
const three = await readFile('node_modules/three/LICENSE', 'utf8');
const sinew = await readFile('../LICENSE', 'utf8');
await writeFile('dist/licences.txt', `Sinew\n\n${sinew}\n\nthree.js ${version}\n\n${three}`);
