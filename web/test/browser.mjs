// SPDX-License-Identifier: BSL-1.0
// A browser that nobody sees, driven by the DevTools protocol through a pipe: messages of JSON that end with 0.
import { spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/** Starts Chromium with software rendering and opens a page of a size. */
export async function openPage(address, { width = 1280, height = 800, ratio = 1 } = {}) {
  const profile = await mkdtemp(join(tmpdir(), 'sinew-page-'));
  const chromium = spawn(
    process.env.CHROMIUM ?? 'chromium',
    [
      '--headless',
      '--no-sandbox',
      '--disable-gpu-sandbox',
      '--use-gl=angle',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--hide-scrollbars',
      '--no-first-run',
      '--disable-background-networking',
      `--user-data-dir=${profile}`,
      '--remote-debugging-pipe',
      'about:blank',
    ],
    { stdio: ['ignore', 'ignore', 'pipe', 'pipe', 'pipe'] },
  );
  let cries = ''; // of the browser itself
  chromium.stderr.on('data', (data) => (cries += data));
  chromium.on('error', (error) => over(error));
  chromium.on('exit', () => over(new Error(`chromium has ended:\n${cries}`)));
  const [, , , toBrowser, fromBrowser] = chromium.stdio;
  toBrowser.on('error', () => {}); // it has ended
  const answers = new Map();
  const messages = []; // of the console, and errors
  let number = 0;
  let session;
  function over(error) {
    for (const { reject } of answers.values()) reject(error);
    answers.clear();
  }
  const parts = []; // of a message
  fromBrowser.on('data', (data) => {
    for (let end = data.indexOf(0); end >= 0; end = data.indexOf(0)) {
      parts.push(data.subarray(0, end));
      hear(JSON.parse(Buffer.concat(parts.splice(0))));
      data = data.subarray(end + 1);
    }
    parts.push(data);
  });
  function hear(said) {
    if (said.id) {
      const { resolve, reject } = answers.get(said.id);
      answers.delete(said.id);
      if (said.error) reject(new Error(said.error.message));
      else resolve(said.result);
    } else if (said.method === 'Runtime.exceptionThrown') {
      messages.push(said.params.exceptionDetails.exception?.description ?? said.params.exceptionDetails.text);
    } else if (said.method === 'Runtime.consoleAPICalled') {
      messages.push(said.params.args.map((arg) => arg.value ?? arg.description).join(' '));
    } else if (said.method === 'Log.entryAdded') {
      messages.push(said.params.entry.text);
    }
  }
  const ask = (method, params = {}) =>
    new Promise((resolve, reject) => {
      answers.set(++number, { resolve, reject });
      toBrowser.write(`${JSON.stringify({ id: number, method, params, sessionId: session })}\0`);
    });
  const { targetId } = await ask('Target.createTarget', { url: 'about:blank' });
  session = (await ask('Target.attachToTarget', { targetId, flatten: true })).sessionId;
  for (const domain of ['Runtime', 'Page', 'Log']) await ask(`${domain}.enable`);
  await ask('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: ratio, mobile: false });
  await ask('Page.navigate', { url: address });

  const evaluate = async (expression) => {
    const { result, exceptionDetails } = await ask('Runtime.evaluate', {
      expression,
      awaitPromise: true,
      returnByValue: true,
    });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  };
  return {
    messages,
    ask,
    evaluate,
    /** Until an expression is true. */
    async until(expression, seconds = 60) {
      const end = Date.now() + 1000 * seconds;
      while (!(await evaluate(`!!(${expression})`))) {
        if (Date.now() > end) throw new Error(`${expression} is not so after ${seconds} s\n${messages.join('\n')}`);
        await new Promise((resolve) => setTimeout(resolve, 20));
      }
    },
    async mouse(type, x, y, button = 'left') {
      await ask('Input.dispatchMouseEvent', {
        type: { down: 'mousePressed', up: 'mouseReleased', move: 'mouseMoved' }[type],
        x,
        y,
        button: type === 'move' ? 'none' : button,
        buttons: type === 'up' ? 0 : 1,
        clickCount: type === 'move' ? 0 : 1,
      });
    },
    async key(key) {
      await ask('Input.dispatchKeyEvent', { type: 'keyDown', key, text: key });
      await ask('Input.dispatchKeyEvent', { type: 'keyUp', key });
    },
    /** As a PNG. */
    async picture() {
      return Buffer.from((await ask('Page.captureScreenshot', { format: 'png' })).data, 'base64');
    },
    async close() {
      const ended = new Promise((resolve) => chromium.on('exit', resolve));
      await ask('Browser.close').catch(() => chromium.kill());
      await ended;
      await rm(profile, { recursive: true, force: true, maxRetries: 5 });
    },
  };
}
