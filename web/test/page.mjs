// SPDX-License-Identifier: BSL-1.0
// The page in a browser that nobody sees, with each of its engines: what is seen, what is pulled, and how fast.
//   node test/page.mjs --program build/sinew --native build/page_liver --alone out/page [--pictures folder] [--fast]
import { execFileSync, spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { dirname, extname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { SmoothSurface } from '../src/smooth.js';
import { openPage } from './browser.mjs';

const { values: options } = parseArgs({
  options: {
    program: { type: 'string' },
    native: { type: 'string' },
    alone: { type: 'string' },
    pictures: { type: 'string' },
    fast: { type: 'boolean' },
  },
});
const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const scene = join(root, 'examples/scenes/liver.scn');
let checks = 0;
function check(condition, what) {
  if (!condition) throw new Error(`failed: ${what}`);
  ++checks;
}
const keep = (name, png) => {
  if (!options.pictures) return;
  mkdirSync(options.pictures, { recursive: true });
  writeFileSync(join(options.pictures, name), png);
};
const pause = (seconds) => new Promise((done) => setTimeout(done, 1000 * seconds));

// the skin, as the page shows it
const skin = `(() => {
  const body = sinew.view.bodies.find((b) => b.visual);
  return [...sinew.view.frame.positions.subarray(3 * body.first, 3 * (body.first + body.points))];
})()`;
function compare(shown, native, what) {
  check(shown.length === native.length && native.length > 1000, `${what}: as many points`);
  const size = native.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
  const apart = native.reduce((most, x, i) => Math.max(most, Math.abs(x - shown[i])), 0);
  console.log(`  ${what}: ${native.length / 3} points, ${(apart / size).toExponential(1)} of the body apart`);
  check(apart < 1e-6 * size, `${what}: positions agree to 6 digits`);
}

// what the user does on either engine
async function use(page, name, native) {
  await page.until('globalThis.sinew?.frames > 0', 60);
  console.log(`  first frame after ${(await page.evaluate('sinew.firstFrame')).toFixed(0)} ms`);
  await page.until('sinew.tree.length > 0');
  check(await page.evaluate(`sinew.tree.some((line) => line.class?.startsWith('EulerImplicitSolver'))`), 'the tree is told');
  for (let step = 1; step <= 20; ++step) await page.key('n');
  await page.until('sinew.state.step === 20 && sinew.view.frame.step === 20', 60);
  check(!(await page.evaluate('sinew.state.playing')), 'after steps it stands');
  compare(await page.evaluate(skin), native, 'after 20 steps');

  // a picture is not empty: the body is orange on a ground that is not
  const pixel = await page.evaluate(`(() => {
    sinew.view.draw();
    const c = document.createElement('canvas');
    const { width, height } = sinew.view.canvas;
    Object.assign(c, { width, height });
    const draw = c.getContext('2d');
    draw.drawImage(sinew.view.canvas, 0, 0);
    const { data } = draw.getImageData(0, 0, width, height);
    let body = 0;
    for (let i = 0; i < data.length; i += 4) body += data[i + 3] > 200 && data[i] > data[i + 2] + 40;
    return body / (width * height);
  })()`);
  check(pixel > 0.05 && pixel < 0.7, `the body covers a part of the picture: ${pixel}`);

  // beside the body the camera turns
  const eye = await page.evaluate('sinew.view.orbit.toEye.toArray()');
  const [left, top, width, height] = await page.evaluate(
    `(({ left, top, width, height }) => [left, top, width, height])(sinew.view.canvas.getBoundingClientRect())`,
  );
  check(!(await page.evaluate('sinew.view.meets(10, 10)')), 'there is nothing in the corner');
  await page.mouse('move', left + 10, top + 10);
  await page.mouse('down', left + 10, top + 10);
  await page.mouse('move', left + 60, top + 10);
  await page.mouse('up', left + 60, top + 10);
  const turned = await page.evaluate('sinew.view.orbit.toEye.toArray()');
  check(Math.hypot(...turned.map((x, k) => x - eye[k])) > 0.1, 'the camera turns');
  check((await page.evaluate('sinew.state.held')) === null, 'and nothing is held');

  // on it, it is pulled: to the right of its middle, so that its lobe gives way
  await page.key('f');
  const [x, y] = await page.evaluate(`(() => {
    const { view } = sinew;
    for (let u = 0.9; u > 0.1; u -= 0.01)
      if (view.meets(view.width * u, view.height / 2)) return [view.width * (u - 0.05), view.height / 2];
  })()`);
  const before = await page.evaluate(skin);
  await page.mouse('move', left + x, top + y);
  await page.mouse('down', left + x, top + y);
  await page.until('sinew.state.held');
  for (let k = 1; k <= 8; ++k) await page.mouse('move', left + x + 12 * k, top + y - 8 * k);
  await page.key(' ');
  await page.until('sinew.state.step >= 60', 60);
  await page.until(`sinew.state.held && Math.hypot(...sinew.state.held.force) > 0.01`);
  await pause(1);
  const held = await page.evaluate('sinew.state.held');
  // the force is that of the spring, towards the pointer
  const spring = held.target.map((t, k) => t - held.point[k]);
  const cosine =
    held.force.reduce((sum, f, k) => sum + f * spring[k], 0) / (Math.hypot(...held.force) * Math.hypot(...spring));
  check(cosine > 0.99, `the force is along the spring: ${cosine}`);
  check(/[0-9] N$/.test(await page.evaluate(`document.getElementById('heldForce').textContent`)), 'and is shown');
  check(await page.evaluate(`document.getElementById('held').getAttribute('visibility') === 'visible'`), 'with an arrow');
  keep(`${name}-pulled.png`, await page.picture());
  const moved = (await page.evaluate(skin)).reduce((most, p, k) => Math.max(most, Math.abs(p - before[k])), 0);
  check(moved > 0.002, `the body is pulled: ${moved} m`);
  await page.mouse('up', left + x + 96, top + y - 64);
  await page.until('sinew.state.held === null');

  // a field is changed
  await page.evaluate(
    `[...document.querySelectorAll('#tree .component')].find((item) => /FEMForceField/.test(item.title)).click()`,
  );
  await page.until(`document.querySelector('#fields input')`);
  const field = `[...document.querySelectorAll('#fields label')].find((label) => label.textContent.startsWith('youngModulus')).querySelector('input')`;
  const give = (value) =>
    page.evaluate(`(() => { const i = ${field}; i.value = '${value}'; i.dispatchEvent(new Event('change')); })()`);
  await give('9000');
  await page.until(`sinew.state.undo === 'youngModulus' && ${field}.value === '9000'`);
  await give('-1');
  await page.until(`document.getElementById('error').textContent.includes('youngModulus')`);
  await page.until(`${field}.value === '9000'`);
  keep(`${name}-fields.png`, await page.picture());
  await page.evaluate(`document.getElementById('undo').click()`);
  await page.until(`sinew.state.redo === 'youngModulus'`);
  // colours show stress, and then bodies again
  const choose = (by) =>
    page.evaluate(`(() => { const s = document.getElementById('colour'); s.value = '${by}'; s.dispatchEvent(new Event('change')); })()`);
  await choose('vonMises');
  await page.until(`sinew.state.legend?.unit === 'Pa' && sinew.state.legend.high > 10 && sinew.view.frame.values`);
  check(
    await page.evaluate(`(() => {
      const { low, high } = sinew.state.legend;
      const known = [...sinew.view.frame.values].filter((x) => x === x);
      return known.length > 100 && known.every((x) => x > -1e-6 * high);
    })()`),
    'points have their stress',
  );
  await page.until(`!document.getElementById('legend').hidden`);
  await pause(0.5);
  keep(`${name}-stress.png`, await page.picture());
  await choose('none');
  await page.until('sinew.state.legend === null && !sinew.view.frame.values');
  // back to the start
  await page.key(' ');
  await page.until('!sinew.state.playing');
  await page.key('r');
  await page.until('sinew.state.step === 0');
  check(page.messages.length === 0, `the console is empty: ${page.messages.join('\n')}`);
}

// what a user drops onto the page: one or several files, of text or a list of bytes
const drop = (page, files) =>
  page.evaluate(`(() => {
    const carried = new DataTransfer();
    for (const [name, content] of ${JSON.stringify(Object.entries(files))})
      carried.items.add(new File([typeof content === 'string' ? content : new Uint8Array(content)], name));
    const tell = (kind) => document.querySelector('main').dispatchEvent(new DragEvent(kind, { dataTransfer: carried, bubbles: true, cancelable: true }));
    tell('dragenter');
    const marked = getComputedStyle(document.getElementById('dropHint')).display !== 'none';
    tell('drop');
    return marked;
  })()`);
const ball = `<Node name="ball" gravity="0 0 -9.81" dt="0.02"><EulerExplicitSolver/>
  <MechanicalObject template="Vec3d" position="1 2 3  2 2 3"/><UniformMass totalMass="1"/></Node>`;

// another scene in the place of that of the command line, and the time of its components
async function opens(page) {
  const said = (words) => page.until(`document.getElementById('error').textContent.includes(${JSON.stringify(words)})`);
  check(!(await page.evaluate(`document.getElementById('open').hidden`)), 'scenes can be chosen');
  check(await drop(page, { 'a.scn': '<Node>\n<EulerSolverr/></Node>' }), 'the place to drop is shown');
  await said('a.scn:2:');
  await drop(page, { 'organ.obj': 'v 0 0 0' });
  await said('there is no scene among the files');
  await page.evaluate(`sinew.send({ do: 'step' })`);
  await page.until(`document.getElementById('error').hidden`);
  await drop(page, { 'ball.scn': ball });
  await page.until(`document.getElementById('title').textContent === 'ball.scn' && sinew.view.frame?.positions.length === 6`);
  check(await page.evaluate(`sinew.tree[0].name === 'ball' && sinew.state.step === 0`), 'another scene is there');
  check(await page.evaluate(`Math.hypot(...sinew.view.orbit.target.toArray().map((x, k) => x - [1.5, 2, 3][k])) < 1e-6`), 'and seen as a whole');
  await page.key('n');
  await page.until('sinew.state.step === 1 && sinew.view.frame.positions[2] < 3');
  check(await page.evaluate(`document.getElementById('message').hidden && !document.body.classList.contains('over')`), 'nothing is in front of it');
  // the time of its components
  await page.evaluate(`document.querySelector('#profile summary').click()`);
  await page.until('sinew.state.profiling');
  await page.key(' ');
  await page.until(`document.querySelectorAll('#profileList li').length > 2`);
  const shares = await page.evaluate('sinew.state.profile.shares');
  check(Math.abs(shares.reduce((sum, s) => sum + s.share, 0) - 1) < 1e-9, 'the times of all are the whole');
  check(shares.some((s) => s.class === 'UniformMass<Vec3d>'), 'components have their times');
  const saved = await page.evaluate(`(async () => {
    const kept = [];
    const { createObjectURL } = URL;
    URL.createObjectURL = (blob) => (kept.push(blob.text()), createObjectURL(blob));
    document.getElementById('profileCsv').click();
    document.getElementById('profileSvg').click();
    URL.createObjectURL = createObjectURL;
    return Promise.all(kept);
  })()`);
  check(saved[0].startsWith('component or phase,class,') && saved[0].includes('UniformMass<Vec3d>'), `they are a table: ${saved[0]}`);
  check(saved[1].startsWith('<svg') && saved[1].split('<rect').length - 1 === shares.length, 'and a picture');
  keep('profile.png', await page.picture());
  await page.evaluate(`document.querySelector('#profile summary').click()`);
  await page.until('!sinew.state.profiling && !sinew.state.profile');
  await plots(page);
  await textures(page);
  check(page.messages.filter((m) => !/422/.test(m)).length === 0, `the console is empty: ${page.messages.join('\n')}`);
}

// what is measured of the ball, which falls freely: its kinetic energy is m/2 (g t)^2, of 1 kg as it is at the end of a step
async function plots(page) {
  await page.key(' ');
  await page.until('!sinew.state.playing');
  await page.evaluate(`document.querySelector('#plots summary').click()`);
  await page.key('r');
  await page.until('sinew.state.step === 0');
  for (let step = 0; step < 10; ++step) await page.key('n');
  await page.until('sinew.measures.times.length === 10');
  const energies = () => page.evaluate(`(({ times, series }) => [times, series.find((s) => s.name === 'kinetic energy').values])(sinew.measures)`);
  const falls = ([times, values]) => times.every((t, i) => Math.abs(values[i] - (9.81 * t) ** 2 / 2) < 1e-9 * values.at(-1));
  check(falls(await energies()), 'the energy is that of a ball that falls');
  // what comes later is put behind it; a field begins all anew
  for (let step = 0; step < 5; ++step) await page.key('n');
  await page.until('sinew.measures.times.length === 15');
  check(falls(await energies()), 'and stays that');
  await page.evaluate(`[...document.querySelectorAll('#tree .component')].find((item) => /UniformMass/.test(item.title)).click()`);
  await page.until(`[...document.getElementById('plotField').options].some((option) => option.value === 'totalMass')`);
  await page.evaluate(`(() => { const s = document.getElementById('plotField'); s.value = 'totalMass'; s.dispatchEvent(new Event('change')); })()`);
  for (let step = 0; step < 3; ++step) await page.key('n');
  await page.until(`sinew.measures.series.length === 4 && sinew.measures.times.length === 3`);
  check(await page.evaluate(`sinew.measures.series[3].unit === 'kg' && sinew.measures.series[3].values.every((m) => m === 1)`), 'a field is measured');
  check((await page.evaluate(`[...document.querySelectorAll('#plotList polyline')].map((line) => line.getAttribute('points').split(' ').length)`)).join() === '3,3,3,3', 'all are drawn');
  const saved = await page.evaluate(`(async () => {
    const kept = [];
    const { createObjectURL } = URL;
    URL.createObjectURL = (blob) => (kept.push(blob.text()), createObjectURL(blob));
    document.getElementById('plotCsv').click();
    document.getElementById('plotSvg').click();
    URL.createObjectURL = createObjectURL;
    return Promise.all(kept);
  })()`);
  const lines = saved[0].trim().split('\n');
  check(lines.length === 4 && lines[0].startsWith('time [s],time of a step [ms],kinetic energy [J],') && Math.abs(Number(lines[1].split(',')[0]) - 0.32) < 1e-12, `they are a table: ${saved[0]}`);
  check(saved[1].startsWith('<svg') && saved[1].split('<polyline').length - 1 === 4, 'and a picture');
  keep('plots.png', await page.picture());
  keep('plots.svg', saved[1]);
  // behind a reset, time begins anew
  await page.key('r');
  await page.until('sinew.measures.times.length === 0');
  await page.evaluate(`document.querySelector('#plots summary').click()`);
}

// a square with the four texels of its image, and one with the colour of its material, from the front
async function textures(page) {
  const texels = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]]; // the lower row first, as a file BMP has them
  const bytes = Buffer.alloc(70);
  bytes.write('BM');
  for (const [at, value] of [[2, 70], [10, 54], [14, 40], [18, 2], [22, 2], [34, 16]]) bytes.writeUInt32LE(value, at);
  bytes.writeUInt16LE(1, 26);
  bytes.writeUInt16LE(24, 28);
  texels.forEach(([r, g, b], i) => bytes.set([b, g, r], 54 + 8 * Math.floor(i / 2) + 3 * (i % 2)));
  await drop(page, {
    'square.scn': `<Node name="square"><Node name="textured"><OglModel filename="square.obj"/></Node></Node>`,
    'square.obj': `mtllib square.mtl
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1
usemtl image\nf 1/1 2/2 3/3 4/4\nusemtl plain\nf 2 5 6 3\n`,
    'square.mtl': 'newmtl image\nKd 1 1 1\nmap_Kd square.bmp\nnewmtl plain\nKd 0 1 1\n',
    'square.bmp': [...bytes],
  });
  await page.until(`document.getElementById('title').textContent === 'square.scn' && sinew.view.textures[0]?.image && sinew.view.bodies.length === 2`);
  await page.key('z');
  const colours = await page.evaluate(`(() => {
    sinew.view.draw();
    const c = document.createElement('canvas');
    const { width, height } = sinew.view.canvas;
    Object.assign(c, { width, height });
    const draw = c.getContext('2d', { willReadFrequently: true });
    draw.drawImage(sinew.view.canvas, 0, 0);
    return [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75], [1.5, 0.5]].map(([x, y]) => {
      const [u, v] = sinew.view.project([x, y, 0]).map((p) => Math.round(p * sinew.view.renderer.getPixelRatio()));
      return [...draw.getImageData(u, v, 1, 1).data];
    });
  })()`);
  // in the light, but which channels there are is the image's
  [...texels, [0, 255, 255]].forEach((texel, i) =>
    check(texel.every((part, k) => (part ? colours[i][k] > 120 : colours[i][k] < 100)), `texel ${i} is ${texel}: ${colours[i]}`),
  );
  keep('textures.png', await page.picture());
}

async function served() {
  console.log('the page of sinew serve');
  const native = nativeLiver();
  const program = spawn(options.program, ['serve', scene, '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  try {
    const link = await new Promise((done) => program.stdout.once('data', (data) => done(String(data).split('\n')[0])));
    const page = await openPage(link);
    try {
      await use(page, 'served', native);
      await opens(page);
    } finally {
      await page.close();
    }
  } finally {
    program.kill('SIGINT');
  }
  const status = await new Promise((done) => (program.exitCode === null ? program.on('exit', done) : done(program.exitCode)));
  check(status === 0, `sinew serve ends: ${status}`);
}
// the skin of the scene after 20 steps of the program
function nativeLiver() {
  const folder = mkdtempSync(join(tmpdir(), 'sinew-native-'));
  execFileSync(options.program, ['run', scene, '--steps', '20', '--every', '20', '--vtk', folder, '--quiet']);
  const points = visual(folder);
  rmSync(folder, { recursive: true });
  return points;
}
// the points of the visual model in the last file of a series, of which --vtk writes one for each body
function visual(folder) {
  const last = readdirSync(folder, { recursive: true })
    .filter((file) => file.endsWith('.vtu'))
    .sort()
    .at(-1);
  // in base64, after their length in 8 bytes
  const packed = readFileSync(join(folder, last), 'utf8').match(/<Points>\s*<DataArray type="Float64"[^>]*format="binary">([^<]*)</)[1];
  const bytes = Buffer.from(packed.trim(), 'base64');
  return Array.from({ length: (bytes.length - 8) / 8 }, (_, k) => bytes.readDoubleLE(8 + 8 * k));
}

async function alone() {
  console.log('the page as a folder of files');
  const files = readdirSync(options.alone);
  const sizeOf = (some) => some.reduce((sum, file) => sum + statSync(join(options.alone, file)).size, 0) / 1e6;
  const later = files.filter((file) => file.startsWith('scenes.')); // when a scene is dropped
  const first = sizeOf(files) - sizeOf(later);
  console.log(`  ${first.toFixed(2)} MB, and for scene files ${sizeOf(later).toFixed(2)} MB`);
  check(first < 1.5 && later.length === 2, 'it is below 1.5 MB');
  const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json', '.svg': 'image/svg+xml', '.txt': 'text/plain' };
  const server = createServer((request, answer) => {
    const file = new URL(request.url, 'http://localhost').pathname.slice(1) || 'index.html';
    if (!files.includes(file)) return answer.writeHead(404).end();
    answer.setHeader('content-type', types[extname(file)] ?? 'application/octet-stream');
    answer.end(readFileSync(join(options.alone, file)));
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const page = await openPage(`http://127.0.0.1:${server.address().port}/`);
  try {
    const native = execFileSync(options.native, ['20'], { encoding: 'utf8' }).trim().split(/\s+/).map(Number);
    await use(page, 'alone', native);
    // without drawing, which software does here on the same processor
    await page.evaluate('sinew.view.draw = () => {}');
    const most = await speed(page);
    // of a machine that has nothing else to do
    if (options.fast) check(most > 500, 'it makes 500 steps a second');
    // the other scene: the tool moves by itself
    await page.evaluate(`(() => { const s = document.getElementById('scenes'); s.value = 'vitrectomy'; s.dispatchEvent(new Event('change')); })()`);
    await page.until(`location.search === '?scene=vitrectomy' && globalThis.sinew?.frames > 0 && sinew.tree.some((l) => l.name === 'tool')`, 60);
    const tool = `(() => { const b = sinew.view.bodies.find((b) => b.path === '/root/tool/tip'); return [...sinew.view.frame.positions.subarray(3 * b.first, 3 * b.first + 3)]; })()`;
    const from = await page.evaluate(tool);
    await page.evaluate(`sinew.send({ do: 'speed', times: 0 }), sinew.send({ do: 'play', on: true })`);
    await page.until('sinew.view.frame.time > 2.5', 120);
    const to = await page.evaluate(tool);
    check(Math.hypot(...to.map((x, k) => x - from[k])) > 0.001, 'the tool of the vitrectomy moves');
    keep('vitrectomy.png', await page.picture());
    await opensAlone(page);
    check(page.messages.length === 0, `the console is empty: ${page.messages.join('\n')}`);
  } finally {
    await page.close();
    server.close();
  }
}

// scene files, by the module that is loaded for them; what is wrong with one is said, and the scene before goes on
async function opensAlone(page) {
  const said = (words) => page.until(`document.getElementById('error').textContent.includes(${JSON.stringify(words)})`, 60);
  const goesOn = async () => {
    const { step } = await page.evaluate('sinew.state');
    await page.evaluate(`sinew.send({ do: 'step' })`);
    await page.until(`sinew.state.step > ${step} && document.getElementById('error').hidden`);
  };
  const wrong = async (files, words) => {
    await drop(page, files);
    await said(words);
    await goesOn();
  };
  const text = readFileSync(scene, 'utf8');
  const mesh = readFileSync(join(root, 'examples/scenes/data/organ.obj'), 'utf8');
  let seed = 1;
  const noise = Array.from({ length: 5000 }, () => (seed = (48271 * seed) % 2147483647) % 256);
  await page.evaluate(`sinew.send({ do: 'play', on: false })`);
  await page.until('!sinew.state.playing');
  check(!(await page.evaluate(`document.getElementById('open').hidden`)), 'scenes can be chosen');
  await wrong({ 'a.scn': '<Node>\n<EulerSolverr/></Node>' }, 'a.scn:2:');
  await wrong({ 'a.scn': '<Node>\n<MechanicalObject</Node>' }, 'a.scn:2:');
  await wrong({ 'a.scn': '<Node>\n<SPHFluidForceField/></Node>' }, 'SPHFluidForceField');
  await wrong({ 'a.scn': '<Node>'.repeat(300000) }, 'a.scn:1:');
  await wrong({ 'a.scn': '<Node a="</">'.repeat(100000) }, 'a.scn:1:');
  await wrong({ 'a.scn': '<'.repeat(1000000) }, 'a.scn:1:');
  await wrong({ 'a.scn': noise }, 'a.scn:1:');
  await wrong({ 'organ.obj': mesh }, 'there is no scene among the files');
  await wrong({ 'liver.scn': text }, `there is no file 'data/organ.obj'; drop it along with the scene`);
  await wrong({ 'liver.scn': text, 'organ.obj': noise }, 'organ.obj');
  check(await page.evaluate(`sinew.tree.some((line) => line.name === 'tool')`), 'the scene before is still there');

  // the mesh beside the scene, which looks for it in a folder
  await drop(page, { 'liver.scn': text, 'organ.obj': mesh });
  await page.until(`document.getElementById('title').textContent === 'liver.scn' && sinew.state.step === 0 && sinew.view.frame`, 60);
  for (let step = 1; step <= 20; ++step) await page.key('n');
  await page.until('sinew.state.step === 20 && sinew.view.frame.step === 20', 60);
  if (options.program) compare(await page.evaluate(skin), nativeLiver(), 'a scene file after 20 steps');
  keep('alone-dropped.png', await page.picture());
  await page.evaluate('sinew.view.draw = () => {}');
  await speed(page);
  // and another one in its place
  await drop(page, { 'ball.scn': ball });
  await page.until(`document.getElementById('title').textContent === 'ball.scn' && sinew.view.frame?.positions.length === 6`, 60);
  await goesOn();
  await page.evaluate('delete sinew.view.draw');
  await textures(page);
}
// the most steps a second of some seconds, where all of the machine makes them
async function speed(page) {
  await page.evaluate(`sinew.send({ do: 'speed', times: 0 }), sinew.send({ do: 'play', on: true })`);
  let most = 0;
  for (let k = 0; k < (options.fast ? 5 : 1); ++k) {
    await pause(1);
    most = Math.max(most, await page.evaluate('sinew.state.stepsPerSecond'));
  }
  console.log(`  ${most.toFixed(0)} steps/s`);
  return most;
}

// two faces that meet at 20 degrees have one normal where they meet, also where each is a part of its own
function borders() {
  const angle = Math.PI / 9;
  const points = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -Math.cos(angle), Math.sin(angle)]);
  const faces = [Uint32Array.of(0, 1, 2), Uint32Array.of(1, 0, 3)];
  const normalsOf = (surface, corners) => [...corners].map((v) => [...surface.normals.subarray(3 * v, 3 * v + 3)]);
  const whole = new SmoothSurface(Uint32Array.of(...faces[0], ...faces[1]), points);
  const expected = normalsOf(whole, whole.drawn);
  check(Math.abs(expected[0][1]) > 0.1 && expected[2][1] === 0, 'the normal at the edge is between those of the faces');
  for (const places of [null, Uint32Array.of(2, 1, 0)])
    faces.forEach((own, f) => {
      const part = new SmoothSurface(own, points, places, faces[1 - f]);
      const normals = normalsOf(part, part.drawn);
      check(part.drawn.length === 3 && normals.flat().every((x, k) => x === expected.flat()[9 * f + k]), 'a border is smooth');
    });
}

borders();
if (options.program) await served();
if (options.alone) await alone();
console.log(`${checks} checks passed`);
