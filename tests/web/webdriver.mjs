// Firefox and WebKitGTK on a screen in memory, which a test steers by WebDriver's commands: Firefox takes them by its own protocol
// (Marionette), WebKitGTK's driver over HTTP.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {connect, createServer} from 'node:net';

const EVALUATE = `const done = arguments[arguments.length - 1];
  Promise.resolve().then(() => eval(arguments[0])).then((value) => done({value}), (error) => done({error: String(error)}));`;
const SECONDS_TO_START = 60;

async function freePort() {
  const server = createServer();
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const {port} = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

// Tries something that fails while a program starts.
async function untilItSucceeds(act) {
  const end = Date.now() + 1000 * SECONDS_TO_START;
  for (;;) {
    try {
      return await act();
    } catch (error) {
      if (Date.now() > end) {
        throw error;
      }
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
  }
}

class Browser {
  constructor(program, args, work, environment = {}) {
    this.home = mkdtempSync(`${work}/browser`);
    this.process = spawn(program, args(this.home),
      {stdio: 'ignore', detached: true, env: {...process.env, HOME: this.home, XDG_RUNTIME_DIR: this.home, ...environment}});
  }

  // Evaluates an expression, and waits if it is a promise.
  async evaluate(expression) {
    const {value, error} = await this.execute(EVALUATE, [expression]);
    if (error !== undefined) {
      throw new Error(error);
    }
    return value;
  }

  async until(expression, seconds = 60) {
    const end = Date.now() + 1000 * seconds;
    while (!await this.evaluate(`Promise.resolve(${expression}).then(Boolean)`).catch(() => false)) {
      if (Date.now() > end) {
        throw new Error(`not within ${seconds} s: ${expression}; the page says ${await this.evaluate('document.body.innerText')}`);
      }
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
  }

  close() {
    try {
      process.kill(-this.process.pid, 'SIGKILL');
    } catch {
      // The browser has ended by itself.
    }
    rmSync(this.home, {recursive: true, force: true, maxRetries: 20});
  }
}

export class Firefox extends Browser {
  static async start(program, work, preferences) {
    const port = await freePort();
    const all = {...preferences, 'marionette.port': port};
    const browser = new Firefox('xvfb-run', (home) => {
      writeFileSync(`${home}/user.js`, Object.entries(all).map(([name, value]) =>
        `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});\n`).join(''));
      return ['-a', program, '--marionette', '--no-remote', '--profile', home];
    }, work);
    browser.waiting = new Map();
    browser.sent = 0;
    browser.socket = await untilItSucceeds(() => new Promise((resolve, reject) => {
      const socket = connect(port, '127.0.0.1', () => resolve(socket)).on('error', reject);
    }));
    let rest = Buffer.alloc(0);
    browser.socket.on('data', (data) => {
      rest = Buffer.concat([rest, data]);
      // A message is its length in decimal digits, a colon and JSON.
      for (let colon = rest.indexOf(':'); colon > 0; colon = rest.indexOf(':')) {
        const end = colon + 1 + Number(rest.subarray(0, colon));
        if (rest.length < end) {
          break;
        }
        browser.take(JSON.parse(rest.subarray(colon + 1, end)));
        rest = rest.subarray(end);
      }
    });
    await browser.send('WebDriver:NewSession', {pageLoadStrategy: 'none'});
    await browser.send('WebDriver:SetTimeouts', {script: 300000, pageLoad: 300000});
    return browser;
  }

  take(message) {
    if (Array.isArray(message)) {  // The first message greets.
      const [, id, error, result] = message;
      const {resolve, reject} = this.waiting.get(id);
      this.waiting.delete(id);
      error === null ? resolve(result) : reject(new Error(error.message));
    }
  }

  send(command, parameters) {
    const id = ++this.sent;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, {resolve, reject});
      const text = JSON.stringify([0, id, command, parameters]);
      this.socket.write(`${Buffer.byteLength(text)}:${text}`);
    });
  }

  async open(url) {
    await this.send('WebDriver:Navigate', {url});
    await this.until(`location.href === ${JSON.stringify(url)} && document.readyState !== 'loading'`);
  }

  async execute(script, args) {
    return (await this.send('WebDriver:ExecuteAsyncScript', {script, args, newSandbox: false, sandbox: null})).value;
  }

  async screenshot() {
    return Buffer.from((await this.send('WebDriver:TakeScreenshot', {full: false})).value, 'base64');
  }

  close() {
    this.socket.destroy();
    super.close();
  }
}

export class WebKit extends Browser {
  static async start(program, work) {
    const port = await freePort();
    const browser = new WebKit('xvfb-run', () => ['-a', program, `--port=${port}`, '--host=127.0.0.1'], work);
    browser.url = `http://127.0.0.1:${port}/session`;
    const {sessionId} = await untilItSucceeds(() => browser.send('POST', '', {capabilities: {alwaysMatch: {}}}));
    browser.url += `/${sessionId}`;
    await browser.send('POST', '/timeouts', {script: 300000, pageLoad: 300000});
    return browser;
  }

  async send(method, path, body) {
    const response = await fetch(`${this.url}${path}`, {method, body: JSON.stringify(body), headers: {'content-type': 'application/json'}});
    const {value} = await response.json();
    if (value?.error !== undefined) {
      throw new Error(value.message);
    }
    return value;
  }

  async open(url) {
    await this.send('POST', '/url', {url});
  }

  async execute(script, args) {
    return this.send('POST', '/execute/async', {script, args});
  }

  async screenshot() {
    return Buffer.from(await this.send('GET', '/screenshot'), 'base64');
  }
}
