// SPDX-License-Identifier: BSL-1.0
// What runs the simulation: a program at the other end of a socket, or Sinew itself in a worker. Both give the same
// messages to `receive` (text, or an ArrayBuffer) and take the same commands.

export function socketEngine(address, receive, lost) {
  const socket = new WebSocket(address);
  socket.binaryType = 'arraybuffer';
  let opened = false;
  socket.onopen = () => (opened = true);
  socket.onmessage = (event) => receive(event.data);
  socket.onclose = () => lost(opened ? 'The program has ended, or the connection to it.' : 'The program does not answer, or too many look at it.');
  return {
    name: 'sinew serve',
    send: (command) => socket.readyState === WebSocket.OPEN && socket.send(JSON.stringify(command)),
    close: () => socket.close(),
  };
}

/**
 * A promise of an engine that runs what a module of WebAssembly starts with a content, text or bytes; it is rejected where that does
 * not start. What the engine says it says from `begin()` on.
 */
export function workerEngine({ module, content }, receive, lost) {
  const worker = new Worker(new URL('worker.js', document.baseURI), { type: 'module' });
  return new Promise((started, failed) => {
    const said = []; // before it begins
    const fails = (why) => {
      worker.terminate();
      failed(new Error(why));
    };
    worker.onerror = (event) => fails(event.message || 'WebAssembly could not be started.');
    worker.onmessage = ({ data }) => {
      if (data.started === undefined) return said.push(data);
      if (!data.started) return fails(JSON.parse(said.at(-1)).text);
      worker.onerror = (event) => lost(event.message || 'WebAssembly has ended.');
      worker.onmessage = (event) => receive(event.data);
      started({
        name: 'WebAssembly',
        begin: () => said.splice(0).forEach(receive),
        send: (command) => worker.postMessage(JSON.stringify(command)),
        close: () => worker.terminate(),
      });
    };
    worker.postMessage({ module, content });
  });
}
