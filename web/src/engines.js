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

export function workerEngine(scene, receive, lost) {
  const worker = new Worker(new URL('worker.js', document.baseURI), { type: 'module' });
  worker.onmessage = (event) => receive(event.data);
  worker.onerror = (event) => lost(event.message || 'WebAssembly could not be started.');
  worker.postMessage({ start: scene });
  return {
    name: 'WebAssembly',
    send: (command) => worker.postMessage(JSON.stringify(command)),
    close: () => worker.terminate(),
  };
}
