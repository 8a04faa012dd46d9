// SPDX-License-Identifier: BSL-1.0
// Sinew as WebAssembly, in a thread of its own.

const share = 14; // of a frame [ms]
const waiting = []; // commands, until it has started
let sinew = null;
let timer = null;
const again = new MessageChannel(); // sooner than timers are

function post() {
  for (let at = sinew._sinew_message(); at; at = sinew._sinew_message()) {
    const bytes = sinew.HEAPU8.slice(at, at + sinew._sinew_message_size());
    if (sinew._sinew_message_is_binary()) postMessage(bytes.buffer, [bytes.buffer]);
    else postMessage(new TextDecoder().decode(bytes));
  }
}
// a function of text, or of bytes
function call(name, content) {
  const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : new Uint8Array(content);
  const at = sinew._malloc(bytes.length || 1);
  sinew.HEAPU8.set(bytes, at);
  const result = sinew[name](at, bytes.length);
  sinew._free(at);
  return result;
}
function turn() {
  clearTimeout(timer);
  timer = null;
  for (const json of waiting.splice(0)) call('_sinew_command', json);
  const pause = sinew._sinew_turn(share);
  post();
  if (pause === 0) again.port2.postMessage(null);
  else if (pause > 0) timer = setTimeout(turn, pause);
}
let asked = false; // for a turn
function soon() {
  if (asked || !sinew) return;
  asked = true;
  again.port2.postMessage(null);
}
again.port1.onmessage = () => {
  asked = false;
  turn();
};

onunhandledrejection = ({ reason }) => {
  throw reason; // so that the page hears of it
};
onmessage = async ({ data }) => {
  if (typeof data === 'string') {
    waiting.push(data);
    return soon();
  }
  const { default: create } = await import(`./${data.module}.js`);
  const packed = await fetch(`${data.module}.bin`);
  if (!packed.ok) throw new Error(`${data.module}.bin is not beside the page; build the page again.`);
  const unpacked = new Response(packed.body.pipeThrough(new DecompressionStream('gzip')));
  sinew = await create({ wasmBinary: await unpacked.arrayBuffer(), print() {}, printErr() {} });
  const started = !!call('_sinew_start', data.content);
  post();
  postMessage({ started });
  if (started) soon();
};
