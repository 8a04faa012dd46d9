// SPDX-License-Identifier: BSL-1.0
// Scenes that are dropped onto the page, with the files and folders that they need.

export const most = { files: 64, bytes: 16 << 20 };

// all files of what is dropped, with their paths in the folders that were
async function filesOf(transfer) {
  const entries = [...transfer.items].filter((item) => item.kind === 'file').map((item) => item.webkitGetAsEntry?.() ?? item.getAsFile());
  const found = [];
  const add = (name, file) => {
    found.push({ name, file });
    if (found.length > most.files) throw new Error(`These are more than ${most.files} files; take the scene and what it needs.`);
  };
  async function walk(entry, above) {
    if (entry instanceof File) return add(above + entry.name, entry);
    if (entry?.isFile) return add(above + entry.name, await new Promise((done, fail) => entry.file(done, fail)));
    if (!entry?.isDirectory) return;
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((done, fail) => reader.readEntries(done, fail)); // a hundred at a time
      if (!some.length) return;
      for (const one of some) if (!one.name.startsWith('.')) await walk(one, `${above}${entry.name}/`);
    }
  }
  for (const entry of entries) await walk(entry, '');
  return found;
}

// the bytes that view/protocol.hpp reads: names and lengths, and behind them the files
function packed(files) {
  if (!files.length) throw new Error('There is no file in what was dropped.');
  const bytes = files.reduce((sum, { file }) => sum + file.size, 0);
  if (bytes > most.bytes) throw new Error(`These files have ${(bytes / 1e6).toFixed(0)} MB; ${most.bytes >> 20} MB are allowed.`);
  const list = files.map(({ name, file }) => ({ name, bytes: file.size }));
  return new Blob([`${JSON.stringify({ files: list })}\n`, ...files.map(({ file }) => file)]);
}

/** Gives them to the program at an address; what it noticed. */
export async function upload(body, address) {
  const headers = { 'content-type': 'application/octet-stream' };
  const answer = await fetch(address, { method: 'POST', headers, body }).catch(() => {
    throw new Error('The program does not answer.');
  });
  const words = (await answer.text()).trim();
  if (!answer.ok) throw new Error(words || `The program refuses it (${answer.status}).`);
  return words;
}

/**
 * Takes what is dropped onto the page, or chosen by an input, and gives its bytes to `open`, which promises to say what it noticed.
 * `tell.waits(on)`, `tell.opened(notes)`, `tell.failed(why)` hear what comes of it.
 */
export function takeScenes(input, open, tell) {
  let waits = false;
  async function take(files) {
    if (waits) return;
    waits = true;
    tell.waits(true);
    try {
      tell.opened(await open(packed(await files)));
    } catch (error) {
      tell.failed(error.message);
    } finally {
      waits = false;
      tell.waits(false);
    }
  }
  const carriesFiles = (event) => [...(event.dataTransfer?.types ?? [])].includes('Files');
  let inside = 0; // each element below the pointer tells that it is entered and left
  const mark = (over) => document.body.classList.toggle('over', over);
  addEventListener('dragenter', (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    mark(++inside > 0);
  });
  addEventListener('dragleave', (event) => carriesFiles(event) && mark(--inside > 0));
  addEventListener('dragover', (event) => carriesFiles(event) && event.preventDefault());
  addEventListener('drop', (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    mark((inside = 0) > 0);
    take(filesOf(event.dataTransfer)); // its items are gone after this
  });
  input?.addEventListener('change', () => {
    const files = [...input.files].map((file) => ({ name: file.name, file }));
    input.value = ''; // so that the same may be chosen again
    take(files);
  });
}
