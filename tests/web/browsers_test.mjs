// node browsers_test.mjs FIREFOX|WEBKIT PROGRAM PAGE WORK_FOLDER EDITOR PROJECT VIDEO
// The page in a browser other than Chromium: its self-test draws people over the keyframe and finds the place in a video; a
// visit without a camera shows people from the map's places. Writes screenshots. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {exportFolder, fileIn, serve, skipWithout} from './needs.mjs';
import {PLAYS, READY} from './visitor.mjs';
import {Firefox, WebKit} from './webdriver.mjs';

const [kind, program, page, work, editor, project, video] = process.argv.slice(2);
const firefox = kind === 'FIREFOX';
skipWithout(
  [program, firefox ? 'install firefox-esr' : 'install webkit2gtk-driver'], [`${page}/module.wasm`, 'build the preset `web`'],
  [editor, 'build lararium-editor'], [project, 'run the test acceptance/maquette'], [video, 'set LARARIUM_DATA_DIR'],
  ['/usr/bin/ffmpeg', 'install ffmpeg'], ['/usr/bin/xvfb-run', 'install xvfb']);
const TRUE_FOCAL = 0.875;  // The focal length of the video over its width.
const LEAST_CHANGED = 10;  // Mean change of the picture's levels from one place of the map to another.

mkdirSync(work, {recursive: true});
const folder = `${work}/folder`;
exportFolder(editor, project, page, folder);
const IMAGES = 80;
const IMAGES_PER_SECOND = 4;
execFileSync('ffmpeg', ['-v', 'error', '-y', '-i', video, '-frames:v', IMAGES, '-q:v', '2', `${work}/camera%d.jpg`]);

// Runs in the page: the images stand for the camera. Browsers differ in the films that they can read.
function useImages(count, perSecond) {
  Object.defineProperty(navigator, 'mediaDevices', {value: {async getUserMedia() {
    const images = await Promise.all(Array.from({length: count}, async (_, i) =>
      createImageBitmap(await (await fetch(`/camera${i + 1}.jpg`)).blob())));
    const canvas = Object.assign(document.createElement('canvas'), {width: images[0].width, height: images[0].height});
    const context = canvas.getContext('2d');
    let drawn = 0;
    const draw = () => context.drawImage(images[drawn++ % count], 0, 0);
    draw();
    setInterval(draw, 1000 / perSecond);
    return canvas.captureStream(perSecond);
  }}});
}
const server = await serve((path) => {
  if (path.startsWith('/camera') && path.endsWith('.jpg')) {
    return `${work}${path}`;
  }
  const file = fileIn(folder, path);
  return file?.endsWith('.html')
    ? Buffer.from(readFileSync(file, 'utf8').replace('<head>', `<head><script>(${useImages})(${IMAGES}, ${IMAGES_PER_SECOND})</script>`)) : file;
});
const ok = (text) => console.log(`ok   ${text}`);
const click = (browser, id) => browser.evaluate(`document.getElementById('${id}').click()`);

async function testItself(browser) {
  await browser.open(`${server.origin}/selftest.html`);
  await browser.until(READY);
  await click(browser, 'go');
  await browser.until(`!document.getElementById('copy').disabled`, 240);
  const lines = (await browser.evaluate(`document.getElementById('report').value`)).split('\n');
  console.log(lines.map((line) => `     ${line}`).join('\n'));
  const report = Object.fromEntries(lines.map((line) => line.split(/: (.*)/, 2)));
  assert.match(report['picture without people'], /^good, /);
  assert.match(report['picture with people'], /^good, /);
  ok('people are drawn over the keyframe');
  assert.match(report.place, /^found, /);
  const [, focal] = /focal length ([\d.]+) of the width/.exec(report.lens);
  assert.ok(Math.abs(focal / TRUE_FOCAL - 1) < 0.02, `the focal length is ${focal}, and should be ${TRUE_FOCAL}`);
  ok('the place and the lens are found in a video');
}

// The picture's levels in a coarse raster, read when the next one has been drawn.
const RASTER = `new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => {
  const small = Object.assign(document.createElement('canvas'), {width: 16, height: 16}).getContext('2d');
  small.drawImage(document.getElementById('lararium'), 0, 0, 16, 16);
  resolve(Array.from(small.getImageData(0, 0, 16, 16).data).filter((_, i) => i % 4 === 1));
})))`;

async function watch(browser) {
  await browser.open(`${server.origin}/`);
  await browser.until(READY);
  await click(browser, 'without_camera');
  await browser.until(`${PLAYS} && document.getElementById('lararium').dataset.shows === 'show'`, 200);
  const first = await browser.evaluate(RASTER);
  await browser.evaluate(`{const view = document.getElementById('view'); view.value = view.max;}`);
  await browser.until(`(${RASTER}).then((now) => now.reduce((sum, level, i) => sum + Math.abs(level - ${JSON.stringify(first)}[i]), 0) / 256 > ${LEAST_CHANGED})`);
  writeFileSync(`${work}/walk.png`, await browser.screenshot());
  ok('a visit without a camera shows the places of the map');
}

async function withBrowser(use) {
  const browser = firefox ? await Firefox.start(program, work, {'media.autoplay.default': 0, 'webgl.force-enabled': true})
    : await WebKit.start(program, work);
  try {
    return await use(browser);
  } finally {
    browser.close();
  }
}

try {
  await withBrowser(testItself);
  await withBrowser(watch);
} finally {
  server.close();
}
