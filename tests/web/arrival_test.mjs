// node arrival_test.mjs PAGE CHROMIUM WORK_FOLDER EDITOR PROJECT VIDEO
// Counts what a visitor's phone fetches of the sample at 20 Mbit/s: the bytes until the camera is tracked, until the first person
// stands there, and of the whole show in one language; prints the seconds. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {existsSync, mkdirSync, statSync} from 'node:fs';
import {exportFolder, fileIn, serve, skipWithout, sleep} from './needs.mjs';
import {cameraOptions, press, READY, withBrowser, writeCamera} from './visitor.mjs';

const [page, program, work, editor, project, video] = process.argv.slice(2);
skipWithout(
  [`${page}/module.wasm`, 'build the preset `web`'], [editor, 'build lararium-editor'], [project, 'run ./demo'], [video, 'set LARARIUM_DATA_DIR'],
  [program, 'install chromium'], ['/usr/bin/ffmpeg', 'install ffmpeg']);
const BYTES_PER_SECOND = 20e6 / 8;
const READING_SECONDS = 3;  // A visitor reads the title for so long.
const MOST = {tracking: 4e6, person: 7e6, all: 15e6};

mkdirSync(work, {recursive: true});
const camera = `${work}/camera.y4m`;
writeCamera(video, 640, 480, camera);
const folder = `${work}/folder`;
exportFolder(editor, project, page, folder);

let free = 0;  // When the line to the visitor is free again, milliseconds.
const server = await serve(async (path) => {
  const file = fileIn(folder, path);
  const bytes = file !== undefined && existsSync(file) ? statSync(file).size : 0;
  free = Math.max(free, performance.now()) + 1000 * bytes / BYTES_PER_SECOND;
  await sleep((free - performance.now()) / 1000);
  return file;
});

// Runs in the page: notes bytes and time when it marks its canvas.
function watch() {
  window.noted = {};
  performance.setResourceTimingBufferSize(2000);
  addEventListener('DOMContentLoaded', () => {
    const {dataset} = document.getElementById('lararium');
    new MutationObserver(() => {
      const bytes = performance.getEntriesByType('resource').reduce((sum, {encodedBodySize}) => sum + encodedBodySize, 0);
      const now = {bytes, ms: performance.now()};
      if (dataset.shows === 'guide') {
        window.noted.tracking ??= now;
      }
      if (dataset.people > 0) {
        window.noted.person ??= now;
      }
      if (dataset.shows === 'show') {
        window.noted.all ??= now;
      }
    }).observe(document.getElementById('lararium'), {attributes: true});
  });
}

try {
  await withBrowser(program, work, cameraOptions(camera), async (browser) => {
    await browser.open(`${server.origin}/`, `(${watch})()`);
    await browser.setCamera(server.origin, 'granted');
    await browser.until(READY);
    await sleep(READING_SECONDS);
    const start = await browser.evaluate('performance.now()');
    await press(browser);
    await browser.until('noted.all', 240);
    const noted = JSON.parse(await browser.evaluate('JSON.stringify(noted)'));
    for (const [name, most] of Object.entries(MOST)) {
      const {bytes, ms} = noted[name];
      console.log(`${bytes <= most ? 'ok  ' : 'MISS'} ${name}: ${(bytes / 1e6).toFixed(2)} MB (at most ${most / 1e6}), ` +
        `${((ms - start) / 1000).toFixed(1)} s after the button`);
      assert.ok(bytes > 1e6 && bytes <= most);
    }
  });
} finally {
  server.close();
}
