// Chromium without a screen, which a test steers through the DevTools protocol over pipes.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';

export class Chromium {
  constructor(program, work, options) {
    this.profile = mkdtempSync(`${work}/chromium`);
    this.process = spawn(program, ['--headless=new', '--no-sandbox', '--no-first-run', '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader', '--remote-debugging-pipe', `--user-data-dir=${this.profile}`, ...options, 'about:blank'],
    {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], detached: true});
    this.sent = 0;
    this.waiting = new Map();
    this.console = [];
    let rest = '';
    this.process.stdio[4].setEncoding('utf8').on('data', (text) => {
      const messages = (rest + text).split('\0');
      rest = messages.pop();
      messages.forEach((message) => this.take(JSON.parse(message)));
    });
    this.process.on('exit', () => this.waiting.forEach(({reject}) => reject(new Error('Chromium has ended'))));
  }

  take({id, result, error, method, params}) {
    if (id !== undefined) {
      const {resolve, reject} = this.waiting.get(id);
      this.waiting.delete(id);
      error === undefined ? resolve(result) : reject(new Error(error.message));
    } else if (method === 'Runtime.consoleAPICalled' || method === 'Runtime.exceptionThrown') {
      this.console.push(`${params.type ?? 'exception'} ${JSON.stringify(params.args ?? params.exceptionDetails)}`);
    }
  }

  // sessionId: a page; null: the browser itself.
  send(method, params = {}, sessionId = this.session) {
    const id = ++this.sent;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, {resolve, reject});
      this.process.stdio[3].write(`${JSON.stringify({id, method, params, sessionId: sessionId ?? undefined})}\0`);
    });
  }

  // Opens a page, in which the script runs before the page's own.
  async open(url, script) {
    const {targetId} = await this.send('Target.createTarget', {url: 'about:blank'}, null);
    ({sessionId: this.session} = await this.send('Target.attachToTarget', {targetId, flatten: true}, null));
    await this.send('Runtime.enable');
    await this.send('Page.enable');
    await this.send('Page.addScriptToEvaluateOnNewDocument', {source: script});
    await this.send('Page.navigate', {url});
  }

  // userGesture: as if a visitor had tapped, which browsers ask for before they let sound begin.
  async evaluate(expression, userGesture = false) {
    const {result, exceptionDetails} = await this.send('Runtime.evaluate', {expression, userGesture, returnByValue: true, awaitPromise: true});
    if (exceptionDetails !== undefined) {
      throw new Error(JSON.stringify(exceptionDetails));
    }
    return result.value;
  }

  // Waits until an expression is true. While a page is being loaded, it may fail.
  async until(expression, seconds = 60) {
    const end = Date.now() + 1000 * seconds;
    while (!await this.evaluate(expression).catch(() => false)) {
      if (Date.now() > end) {
        throw new Error(`not within ${seconds} s: ${expression}; the page says ${await this.evaluate('document.body.innerText')}`);
      }
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
  }

  setCamera(origin, setting) {
    return this.send('Browser.setPermission', {origin, permission: {name: 'camera'}, setting}, null);
  }

  // Presses a key by its name, its number and the text that it types.
  async pressKey(key, windowsVirtualKeyCode, text) {
    const code = {' ': 'Space'}[key] ?? (key.length === 1 ? `Key${key.toUpperCase()}` : key);
    await this.send('Input.dispatchKeyEvent', {type: 'keyDown', key, code, windowsVirtualKeyCode, text});
    await this.send('Input.dispatchKeyEvent', {type: 'keyUp', key, code, windowsVirtualKeyCode});
  }

  // Makes a page the one that is seen; others are hidden.
  async show(session) {
    this.session = session;
    await this.send('Page.bringToFront');
  }

  async screenshot(width, height) {
    await this.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: true});
    await new Promise((resolve) => setTimeout(resolve, 1000));
    const {data} = await this.send('Page.captureScreenshot', {format: 'png'});
    return Buffer.from(data, 'base64');
  }

  async close() {
    try {
      process.kill(-this.process.pid, 'SIGKILL');
    } catch {
      // The browser has ended by itself.
    }
    // Processes of the browser go on writing there for as long as they live.
    rmSync(this.profile, {recursive: true, force: true, maxRetries: 20});
  }
}
