// node folder_test.mjs EDITOR PAGE CHROMIUM WORK_FOLDER PROJECT VIDEO
// The folder that lararium-editor export --web writes, in Chromium, from a server of files: an altered or unsigned show is
// refused; a show that was seen once plays without the server; an update is used as a whole or not at all; a full disk
// disturbs nothing. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {appendFileSync, cpSync, mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {Chromium} from './chromium.mjs';
import {exportFolder, fileIn, serve, skipWithout, updateFolder} from './needs.mjs';

const [editor, page, program, work, project, video] = process.argv.slice(2);
skipWithout([`${page}/module.wasm`, 'build the preset `web`'], [editor, 'build lararium-editor'],
  [project, 'run the test acceptance/maquette'], [video, 'set LARARIUM_DATA_DIR'], [program, 'install chromium'],
  ['/usr/bin/ffmpeg', 'install ffmpeg']);

mkdirSync(work, {recursive: true});
const camera = `${work}/camera.y4m`;
execFileSync('ffmpeg', ['-v', 'error', '-y', '-i', video, '-vf', 'trim=end_frame=40,setpts=N/4/TB,fps=4,format=yuv420p', '-f',
  'yuv4mpegpipe', camera]);
const [first, second] = ['first', 'second'].map((name) => `${work}/${name}`);
const report = exportFolder(editor, project, page, first);
assert.ok(report.page > 0 && report.members.cast > 0);

// An update with another title and another drama.
const TITLE = 'The title of the update';
const changed = `${work}/changed.lararium`;
rmSync(changed, {recursive: true, force: true});
cpSync(project, changed, {recursive: true});
const document = JSON.parse(readFileSync(`${changed}/project.json`, 'utf8'));
writeFileSync(`${changed}/project.json`, JSON.stringify({...document, title: TITLE}));
appendFileSync(`${changed}/drama.lua`, '-- changed\n');
rmSync(second, {recursive: true, force: true});
updateFolder(editor, changed, page, second, `${first}-museum`);

const manifestOf = (folder) => JSON.parse(readFileSync(`${folder}/show/manifest.json`, 'utf8'));
const pathOf = (folder, name) => `/show/${manifestOf(folder).members.find((member) => member.name === name).sha256}`;
const flipped = (file) => {
  const bytes = readFileSync(file);
  bytes[bytes.length >> 1] ^= 1;
  return bytes;
};

let folder = first;
let changedFiles = {};  // Path: bytes in place of the file's, or undefined for none.
let asked = [];
const fileOf = (path) => {
  asked.push(path);
  return path in changedFiles ? changedFiles[path] : fileIn(folder, path);
};
let server = await serve(fileOf);
const {origin, port} = server;

const says = (words) => `document.getElementById('text')?.innerText.includes(${JSON.stringify(words)}) && !document.getElementById('card').hidden`;
const PLAYS = `document.getElementById('lararium').dataset.shows === 'show' && document.getElementById('card').hidden && window.drawn > 2`;
// Counts the images that were tracked.
const WATCH = `window.drawn = 0; const Original = Worker; Worker = class extends Original {
  constructor(...options) {
    super(...options);
    setTimeout(() => this.addEventListener('message', ({data}) => window.drawn += data.tracked ? 1 : 0));
  }
};`;
const KEPT = `caches.match(location.origin + '/current').then((found) => found?.text())`;

async function visit(browser) {
  if (browser.session !== undefined) {
    await browser.send('Page.close').catch(() => {});
  }
  await browser.open(`${origin}/`, WATCH);
  await browser.until(`document.getElementById('go')?.onclick`);
  await browser.evaluate(`document.getElementById('go').click()`);
}
const title = (browser) => browser.evaluate('document.title');
const ALTERED = 'This show was altered, or was not copied whole.';

async function refusals(browser) {
  const cast = pathOf(first, 'cast/0.larhuman');
  const cases = {
    'an altered piece': {[cast]: flipped(`${first}${cast}`)},
    'an altered manifest': {'/show/manifest.json': Buffer.from(readFileSync(`${first}/show/manifest.json`, 'utf8').replace(/"title": "./, '"title": "X'))},
    'a missing signature': {'/show/manifest.sig': undefined},
    'an altered signature': {'/show/manifest.sig': flipped(`${first}/show/manifest.sig`)},
    'another key': {'/museum.pub': Buffer.from(`lararium public key 1 ${'07'.repeat(32)}\n`)},
  };
  for (const [name, files] of Object.entries(cases)) {
    changedFiles = files;
    await visit(browser);
    await browser.until(says(ALTERED));
    assert.equal(await browser.evaluate(KEPT), undefined);
    console.log(`ok   ${name} is refused with one sentence`);
  }
  changedFiles = {[cast]: undefined};
  await visit(browser);
  await browser.until(says('The show does not arrive'));
  changedFiles = {};
  await browser.evaluate(`document.getElementById('go').click()`);
  await browser.until(PLAYS);
  console.log('ok   a piece that does not arrive has its sentence, and the show goes on when it does');
}

async function keeping(browser) {
  await browser.until(`${KEPT}.then(Boolean)`);
  const version = await browser.evaluate(KEPT);
  const old = await title(browser);
  assert.notEqual(old, TITLE);
  server.close();
  await visit(browser);
  await browser.until(PLAYS);
  assert.equal(await title(browser), old);
  console.log('ok   plays without the server after one visit');

  const drama = pathOf(second, 'drama.lua');
  const attempts = {
    'a half copied update': {[drama]: undefined},
    'an update with an altered piece': {[drama]: flipped(`${second}${drama}`)},
    'an unsigned update': {'/show/manifest.sig': undefined},
    'an update with an altered manifest': {'/show/manifest.json': Buffer.from(readFileSync(`${second}/show/manifest.json`, 'utf8').replace('"size": ', '"size":  '))},
  };
  folder = second;
  for (const [name, files] of Object.entries(attempts)) {
    changedFiles = files;
    asked = [];
    server = await serve(fileOf, port);
    browser.console.length = 0;
    await visit(browser);
    await browser.until(PLAYS);
    assert.equal(await title(browser), old, name);
    const end = Date.now() + 20_000;
    while (!asked.includes('/show/manifest.json') && Date.now() < end) {
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    await new Promise((resolve) => setTimeout(resolve, 2000));
    assert.ok(asked.includes('/show/manifest.json'), 'the page looks for an update');
    assert.equal(await browser.evaluate(KEPT), version, name);
    console.log(`ok   ${name} is not used`);
    server.close();
  }
  changedFiles = {};
  asked = [];
  server = await serve(fileOf, port);
  await visit(browser);
  await browser.until(`${KEPT}.then((now) => now !== ${JSON.stringify(version)})`);
  // The browser itself looks for another service worker.
  assert.deepEqual(asked.filter((path) => !/manifest|service_worker/.test(path)), [drama], 'what changed is fetched');
  server.close();
  await visit(browser);
  await browser.until(PLAYS);
  assert.equal(await title(browser), TITLE);
  console.log('ok   a whole update is used from the next visit on, without the server');
}

async function withBrowser(use) {
  const browser = new Chromium(program, work, ['--use-fake-device-for-media-stream', `--use-file-for-fake-video-capture=${camera}`]);
  try {
    await browser.setCamera(origin, 'granted');
    await use(browser);
  } catch (error) {
    console.log(browser.console.join('\n'));
    throw error;
  } finally {
    await browser.close();
  }
}

try {
  await withBrowser(async (browser) => {
    await refusals(browser);
    await keeping(browser);
  });
  folder = first;
  server = await serve(fileOf, port);
  await withBrowser(async (browser) => {
    await browser.open(`${origin}/`, WATCH);
    await browser.send('Storage.overrideQuotaForOrigin', {origin, quotaSize: 500_000});
    await browser.until(`document.getElementById('go')?.onclick`);
    await browser.evaluate(`document.getElementById('go').click()`);
    await browser.until(PLAYS);
    const end = Date.now() + 20_000;
    while (!browser.console.some((text) => text.includes('not kept on this device')) && Date.now() < end) {
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
    assert.ok(browser.console.some((text) => text.includes('not kept on this device')), 'the storage is full');
    assert.equal(await browser.evaluate(KEPT), undefined);
    await browser.until(PLAYS);
    console.log('ok   a full storage disturbs nothing');
  });
} finally {
  server.close();
}
