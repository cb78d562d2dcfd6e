// node long_visit_test.mjs PAGE CHROMIUM WORK_FOLDER EDITOR PROJECT VIDEO MINUTES
// A long visit in Chromium to a looped video in place of the camera: permission taken back and given, the page hidden and shown,
// the network cut, storage full, the show begun again. The page says the sentences that are meant for it and no other, and its
// memory does not grow. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {mkdirSync, readdirSync, readFileSync} from 'node:fs';
import {exportFolder, fileIn, serve, skipWithout} from './needs.mjs';
import {cameraOptions, press, PLAYS, READY, withBrowser, writeCamera} from './visitor.mjs';

const [page, program, work, editor, project, video, minutes] = process.argv.slice(2);
skipWithout(
  [`${page}/module.wasm`, 'build the preset `web`'], [editor, 'build lararium-editor'], [project, 'run the test acceptance/maquette'],
  [video, 'set LARARIUM_DATA_DIR'], [program, 'install chromium'], ['/usr/bin/ffmpeg', 'install ffmpeg']);
// The memory of the browser's processes may grow by this factor from the first fifth of the visit to the last.
const MOST_GROWTH = 1.1;
const SENTENCES = ['', 'The camera has stopped', 'The show waits for you', 'That was it', 'The show is loading', 'The camera is not allowed'];

mkdirSync(work, {recursive: true});
const camera = `${work}/camera.y4m`;
writeCamera(video, 640, 480, camera);
const folder = `${work}/folder`;
exportFolder(editor, project, page, folder);
let network = true;
const server = await serve((path) => network ? fileIn(folder, path) : undefined);
const {origin} = server;

// Returns the memory of a process and of all that it has started, in MiB; shared pages are counted in parts.
function memoryOf(root) {
  const parents = new Map();
  for (const pid of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      const [, parent] = /\) \S (\d+)/.exec(readFileSync(`/proc/${pid}/stat`, 'utf8'));
      parents.set(Number(pid), Number(parent));
    } catch {
      // The process has ended.
    }
  }
  const belongs = (pid) => pid === root || (parents.has(pid) && belongs(parents.get(pid)));
  let kib = 0;
  for (const pid of parents.keys()) {
    if (belongs(pid)) {
      try {
        kib += Number(/^Pss:\s+(\d+)/m.exec(readFileSync(`/proc/${pid}/smaps_rollup`, 'utf8'))?.[1] ?? 0);
      } catch {
        // The process has ended.
      }
    }
  }
  return kib / 1024;
}

const TEXT = `document.getElementById('card').hidden ? '' : document.getElementById('text').innerText`;
const wait = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));

const EVENTS = {
  async 'permission taken back and given'(browser) {
    await browser.setCamera(origin, 'denied');
    await browser.until(`(${TEXT}).startsWith('The camera')`);
    await browser.setCamera(origin, 'granted');
    await press(browser);
  },
  async 'page hidden and shown'(browser) {
    const {session} = browser;
    await browser.open('about:blank', '');
    const other = browser.session;
    await wait(2);
    await browser.show(session);
    await browser.send('Page.close', {}, other);
    await browser.until(`(${TEXT}).startsWith('The show waits')`);
    await press(browser);
  },
  async 'network cut'() {
    network = false;
    await wait(5);
    network = true;
  },
  async 'storage full'(browser) {
    await browser.send('Storage.overrideQuotaForOrigin', {origin, quotaSize: 1});
    await wait(2);
    await browser.send('Storage.overrideQuotaForOrigin', {origin});
  },
  async 'show begun again'(browser) {
    await press(browser, 'restart');
  },
};

await withBrowser(program, work, cameraOptions(camera), async (browser) => {
  await browser.open(`${origin}/`, '');
  await browser.until(READY);
  await browser.setCamera(origin, 'granted');
  await press(browser);
  await browser.until(`document.getElementById('lararium').dataset.shows === 'show'`, 300);
  const start = Date.now();
  const samples = [];  // {share, memory}: share of the visit, MiB.
  const names = Object.keys(EVENTS);
  let happened = 0;
  while (Date.now() - start < 60000 * minutes || happened < names.length) {
    const name = names[happened++ % names.length];
    await EVENTS[name](browser);
    for (let i = 0; i < 8; ++i) {
      await wait(2);
      const text = await browser.evaluate(TEXT);
      assert.ok(SENTENCES.some((sentence) => sentence === '' ? text === '' : text.startsWith(sentence)), `after "${name}" the page says "${text}"`);
      if (text.startsWith('That was it')) {
        await press(browser);
      }
    }
    await browser.until(PLAYS);
    samples.push({share: (Date.now() - start) / (60000 * minutes), memory: memoryOf(browser.process.pid)});
  }
  const errors = browser.console.filter((line) => /^(error|exception) /.test(line));
  assert.deepEqual(errors, []);
  const largest = (from, to) => Math.max(...samples.filter(({share}) => share >= from && share <= to).map(({memory}) => memory));
  const [first, last] = [largest(0, 0.2), largest(0.8, Infinity)];
  console.log(`ok   ${happened} disturbances in ${minutes} minutes: ${names.join(', ')}`);
  console.log(`${last <= MOST_GROWTH * first ? 'ok  ' : 'MISS'} memory of the browser: ${first.toFixed(0)} MiB at most in the first fifth, ` +
    `${last.toFixed(0)} in the last (bar ${MOST_GROWTH} times)`);
  assert.ok(last <= MOST_GROWTH * first);
});
server.close();
