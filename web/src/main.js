// SPDX-License-Identifier: BSL-1.0
// The page: a stage is seen and told, whatever runs it.
import { socketEngine, workerEngine } from './engines.js';
import { Fields } from './fields.js';
import { frameKind, kindOf, readFrame, readTextures, readTopology, texturesKind, topologyKind } from './messages.js';
import { takeScenes, upload } from './open.js';
import { csvOfMeasures, Plots, svgOfMeasures } from './plots.js';
import { Pointer } from './pointer.js';
import { csvOf, ProfileList, save, svgOf } from './profile.js';
import { StageView, viridis } from './stage_view.js';
import { Tree } from './tree.js';

const $ = (id) => document.getElementById(id);
const started = performance.now();

let engine = null;
let state = { time: 0, step: 0, playing: false, stepsPerSecond: 0, held: null, error: '' };
let topology = null;
let dirty = true;
let refused = ''; // the last command that was

const send = (command) => {
  if (command.do !== 'move' && command.do !== 'component') refused = '';
  engine?.send(command);
};
const tell = (text) => {
  $('message').textContent = text;
  $('message').hidden = !text;
};

let view = null;
try {
  view = new StageView($('canvas'));
} catch (error) {
  tell(`This browser shows no WebGL 2 (${error.message}); switch graphics acceleration on, or take another browser.`);
  throw error;
}
const pointer = new Pointer(view, send, () => (dirty = true));
const fields = new Fields($('fields'), (line, field, value) => {
  send({ do: 'setField', line, field, value });
  send({ do: 'component', line });
});
const tree = new Tree($('tree'), $('search'), {
  select(number) {
    $('component').hidden = number < 0;
    fields.clear();
    offerFields(null);
    if (number >= 0) send({ do: 'component', line: number });
  },
  setVisible(path, visible) {
    view.setVisible(path, visible);
    dirty = true;
  },
});

const profile = new ProfileList($('profileList'), $('profileNote'));
$('profile').addEventListener('toggle', () => send({ do: 'profile', on: $('profile').open }));
$('profileCsv').addEventListener('click', () => save('profile.csv', 'text/csv', csvOf(profile.profile)));
$('profileSvg').addEventListener('click', () => save('profile.svg', 'image/svg+xml', svgOf(profile.profile)));

const plots = new Plots($('plotList'), $('plotNote'), send);
$('plots').addEventListener('toggle', () => plots.open($('plots').open));
$('plotField').addEventListener('change', () => {
  const field = $('plotField').value;
  if (field) send({ do: 'measureField', line: tree.selected, field });
  $('plotField').value = '';
});
$('plotCsv').addEventListener('click', () => save('plots.csv', 'text/csv', csvOfMeasures(plots.measures)));
$('plotSvg').addEventListener('click', () => save('plots.svg', 'image/svg+xml', svgOfMeasures(plots.measures)));
// the fields of the selected component that can be plotted
function offerFields(component) {
  const names = (component?.fields ?? []).filter((field) => /number/.test(field.kind)).map((field) => field.name);
  const known = [...$('plotField').options].slice(1).map((option) => option.value);
  if (names.join() !== known.join()) $('plotField').replaceChildren($('plotField').options[0], ...names.map((name) => new Option(name, name)));
  $('plotField').disabled = !names.length;
}

// ---- what comes from the engine

function receive(message) {
  if (typeof message !== 'string') {
    const kind = kindOf(message);
    if (kind === texturesKind) {
      view.setTextures(readTextures(message), () => (dirty = true));
    } else if (kind === topologyKind) {
      topology = readTopology(message);
      view.setTopology(topology);
      tree.setBodies(view.bodies);
    } else if (kind === frameKind) {
      const frame = readFrame(message);
      if (frame.topology !== topology?.number) return;
      view.show(frame);
      page.frames += 1;
      page.firstFrame ??= performance.now() - started;
      dirty = true;
    }
    return;
  }
  const said = JSON.parse(message);
  if (said.is === 'scene') {
    $('title').textContent = said.title;
    $('title').title = said.title;
    document.title = `${said.title} – Sinew`;
    $('engine').textContent = engine.name;
    $('engine').className = 'ready';
    tell('');
    tree.choose(-1);
    view.forget(); // another scene is seen as a whole
    $('profile').open = false;
    $('plots').open = false;
    plots.clear();
    tree.set(said.tree);
    tree.setBodies(view.bodies);
  } else if (said.is === 'state') {
    state = said;
    showState();
  } else if (said.is === 'component') {
    if (said.line === tree.selected) {
      $('componentName').textContent = said.class.replace('<', ' <');
      $('componentPath').textContent = said.path + (said.name && said.name !== said.class ? `: ${said.name}` : '');
      fields.show(said);
      offerFields(said);
    }
  } else if (said.is === 'measures') {
    plots.add(said);
  } else if (said.is === 'error') {
    refused = said.text;
    showState();
  }
}
function lost(why) {
  $('engine').textContent = 'not connected';
  $('engine').className = 'lost';
  tell(`${why} Load the page again when it is there.`);
}

const digits = (value, count) => (Number.isFinite(value) ? value.toFixed(count) : '–');
function showState() {
  $('play').textContent = state.playing ? 'Pause' : 'Play';
  $('time').textContent = `${digits(state.time, 2)} s`;
  $('steps').textContent = state.step;
  $('stepRate').textContent = state.playing ? digits(state.stepsPerSecond, 0) : '–';
  const error = refused || state.error;
  $('error').textContent = error;
  $('error').hidden = !error;
  view.setLegend(state.legend);
  $('legend').hidden = !state.legend;
  if (state.legend) {
    const { title, unit, low, high } = state.legend;
    $('legendTitle').textContent = unit ? `${title} [${unit}]` : title;
    $('legendLow').textContent = Number(low.toPrecision(3));
    $('legendHigh').textContent = Number(high.toPrecision(3));
  }
  if (document.activeElement !== $('colour') || state.colour === $('colour').value) $('colour').value = state.colour ?? 'none';
  profile.show(state.profile ?? null, state.profiling);
  $('profileCsv').disabled = $('profileSvg').disabled = !state.profile;
  $('undo').disabled = !state.undo;
  $('redo').disabled = !state.redo;
  $('undo').title = state.undo ? `Take back: ${state.undo}` : 'Nothing was changed';
  $('redo').title = state.redo ? `Do again: ${state.redo}` : 'Nothing was taken back';
  dirty = true;
}

// the spring that pulls, with its force
function showHeld() {
  const held = state.held;
  $('held').setAttribute('visibility', held ? 'visible' : 'hidden');
  if (!held) return;
  const [x, y] = view.project(held.point);
  const [u, v] = view.project(held.target);
  const set = (id, values) => {
    for (const [key, value] of Object.entries(values)) $(id).setAttribute(key, value);
  };
  set('heldLine', { x1: x, y1: y, x2: u, y2: v, visibility: Math.hypot(u - x, v - y) > 8 ? 'inherit' : 'hidden' });
  set('heldPoint', { cx: x, cy: y });
  set('heldTarget', { cx: u, cy: v });
  set('heldForce', { x: u + 14, y: v - 10 });
  const force = Math.hypot(...held.force);
  $('heldForce').textContent = `${force < 1e-3 && force > 0 ? force.toExponential(1) : Number(force.toPrecision(3))} N`;
}

// ---- what the user does

const acts = {
  play: () => send({ do: 'play', on: !state.playing }),
  step: () => send({ do: 'step' }),
  reset: () => send({ do: 'reset' }),
  fit() {
    view.home();
    dirty = true;
  },
  undo: () => send({ do: 'undo' }),
  redo: () => send({ do: 'redo' }),
  close: () => tree.choose(-1),
  helpButton: () => ($('help').open ? $('help').close() : $('help').showModal()),
};
for (const [id, act] of Object.entries(acts)) $(id).addEventListener('click', act);
$('colour').addEventListener('change', () => {
  send({ do: 'colour', by: $('colour').value });
  $('colour').blur();
});
$('legendBar').style.background = `linear-gradient(90deg, ${viridis.map((c) => `rgb(${c})`)})`;
$('speed').addEventListener('change', () => send({ do: 'speed', times: Number($('speed').value) }));
const setStiffness = () => {
  pointer.stiffness = Number((10 ** Number($('stiffness').value)).toPrecision(2));
  $('stiffnessText').textContent = `${pointer.stiffness} N/m`;
};
$('stiffness').addEventListener('input', setStiffness);
setStiffness();

const along = (axis) => () => {
  view.orbit.along(axis);
  dirty = true;
};
const keys = {
  ' ': acts.play,
  n: acts.step,
  r: acts.reset,
  f: acts.fit,
  h: acts.helpButton,
  '?': acts.helpButton,
  '/': () => $('search').focus(),
  u: acts.undo,
  x: along(0),
  y: along(1),
  z: along(2),
};
addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const typing = event.target.matches('input:not([type=range]), select, textarea');
  const act = keys[event.key.toLowerCase()];
  if (typing || !act || ($('help').open && act !== acts.helpButton)) return;
  if (event.key === ' ') event.target.blur?.(); // a button that has the focus is not pressed as well
  event.preventDefault();
  act();
});

// ---- frames

const size = () => {
  const box = $('canvas').parentElement.getBoundingClientRect();
  view.resize(Math.max(1, Math.floor(box.width)), Math.max(1, Math.floor(box.height)), devicePixelRatio);
  dirty = true;
};
new ResizeObserver(size).observe($('canvas').parentElement);
matchMedia('(resolution: 1dppx)').addEventListener('change', size);
size();

let counted = { since: performance.now(), drawn: 0 };
function frame(now) {
  requestAnimationFrame(frame);
  pointer.frame();
  if (dirty) {
    dirty = false;
    view.draw();
    showHeld();
  }
  plots.ask(now, state);
  if (now - counted.since > 1000) {
    const rate = ((view.drawn - counted.drawn) * 1000) / (now - counted.since);
    $('frameRate').textContent = rate > 0 ? rate.toFixed(0) : '–';
    counted = { since: now, drawn: view.drawn };
    // what a component has changes while the scene runs
    if (tree.selected >= 0 && (state.playing || fields.component === null)) send({ do: 'component', line: tree.selected });
  }
}
requestAnimationFrame(frame);

// What tests and curious users look at.
const page = {
  frames: 0,
  firstFrame: null, // [ms]
  get state() {
    return state;
  },
  get view() {
    return view;
  },
  get measures() {
    return plots.measures;
  },
  get tree() {
    return tree.lines.map(({ depth, name, class: className }) => ({ depth, name, class: className }));
  },
  send,
};
globalThis.sinew = page;

// `sinew serve` says here that it runs the scene; a folder of files, that the page does, and which scenes it has
const { engine: kind, scenes, opens } = await fetch('engine.json').then((answer) => (answer.ok ? answer.json() : {}));
let open = async () => {
  throw new Error('This program shows its own scene only.');
};
if (kind === 'socket') {
  const address = new URL('stage', document.baseURI);
  address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:';
  engine = socketEngine(address, receive, lost);
  if (opens) open = (files) => upload(files, new URL('scene', document.baseURI));
  $('open').hidden = !opens;
} else if (kind === 'worker') {
  let starts = 0;
  const run = async (start) => {
    const mine = ++starts;
    const next = await workerEngine(start, receive, lost);
    if (mine !== starts) {
      // another scene was asked for meanwhile
      next.close();
      return refused;
    }
    engine?.close();
    engine = next;
    refused = '';
    engine.begin();
    return refused;
  };
  const asked = new URLSearchParams(location.search).get('scene');
  const chosen = scenes.includes(asked) ? asked : scenes[0];
  $('scenes').replaceChildren(...scenes.map((name) => new Option(name, name, false, name === chosen)));
  $('scenes').addEventListener('change', () => location.assign(`?scene=${encodeURIComponent($('scenes').value)}`));
  $('scenes').hidden = false;
  $('title').hidden = true;
  $('open').hidden = false;
  run({ module: 'sinew', content: chosen }).catch((error) => engine || lost(error.message));
  // with the module of scene files, which is loaded now; until it runs, the scene before does
  open = async (files) => {
    const notes = await run({ module: 'scenes', content: await files.arrayBuffer() });
    $('scenes').value = '';
    $('title').hidden = false;
    return notes;
  };
} else {
  lost('This page has nothing that runs a scene: open it by the link of sinew serve, or build it with ./dev page.');
}
takeScenes($('files'), (files) => open(files), {
  waits(on) {
    if (on) tell('The scene is opened.');
    else if ($('message').textContent === 'The scene is opened.') tell('');
  },
  opened(notes) {
    refused = notes;
    showState();
  },
  failed(why) {
    refused = why;
    showState();
  },
});
