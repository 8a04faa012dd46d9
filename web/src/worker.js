// SPDX-License-Identifier: BSL-1.0
// Sinew as WebAssembly, in a thread of its own.
import createSinew from '../engine/build/sinew.js';

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
function command(json) {
  const bytes = new TextEncoder().encode(json);
  const at = sinew._malloc(bytes.length || 1);
  sinew.HEAPU8.set(bytes, at);
  sinew._sinew_command(at, bytes.length);
  sinew._free(at);
}
function turn() {
  clearTimeout(timer);
  timer = null;
  for (const json of waiting.splice(0)) command(json);
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

onmessage = async ({ data }) => {
  if (typeof data === 'string') {
    waiting.push(data);
    return soon();
  }
  const made = await createSinew({ locateFile: (file) => new URL(file, location.href).href });
  sinew = made;
  const starts = sinew._sinew_start();
  post();
  if (starts) soon();
  else sinew = null;
};
