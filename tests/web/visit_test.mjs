// node visit_test.mjs PAGE CHROMIUM WORK_FOLDER EDITOR PROJECT VIDEO AXE
// A whole visit to the sample in Chromium, mostly by keyboard: title, languages, permission, captions, menu, sound, a hidden
// page, the guide, the end, and what the browser remembers. Checks every screen with axe-core and writes screenshots. The
// test sets the camera's clock forward to reach the end. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {mkdirSync} from 'node:fs';
import {exportFolder, fileIn, serve, skipWithout} from './needs.mjs';
import {cameraOptions, focus, FOCUSED, PLAYS, press, READY, says, Screens, type, withBrowser, writeCamera} from './visitor.mjs';

const [page, program, work, editor, project, video, axe] = process.argv.slice(2);
skipWithout(
  [`${page}/module.wasm`, 'build the preset `web`'], [editor, 'build lararium-editor'], [project, 'run ./demo'], [video, 'set LARARIUM_DATA_DIR'],
  [program, 'install chromium'], ['/usr/bin/ffmpeg', 'install ffmpeg'], [axe, 'run scripts/fetch_axe.sh']);
const LEAST_LEVEL = 1e-4;  // -80 dB: the room's ambience is louder.

mkdirSync(work, {recursive: true});
const camera = `${work}/camera.y4m`;
writeCamera(video, 640, 480, camera);
const folder = `${work}/folder`;
exportFolder(editor, project, page, folder);
const server = await serve((path) => fileIn(folder, path));
const screens = new Screens(work, axe);

// Runs in the page: sets the camera's clock forward by `ahead`, and listens to what goes to the loudspeakers.
function prepare() {
  window.ahead = 0;
  window.asked = 0;  // How often the page asked for the camera.
  const {mediaDevices} = navigator;
  const ask = mediaDevices.getUserMedia.bind(mediaDevices);
  mediaDevices.getUserMedia = (...options) => {
    ++window.asked;
    return ask(...options);
  };
  const request = HTMLVideoElement.prototype.requestVideoFrameCallback;
  HTMLVideoElement.prototype.requestVideoFrameCallback = function (use) {
    return request.call(this, (now, frame) => use(now, {mediaTime: frame.mediaTime + window.ahead, presentedFrames: frame.presentedFrames}));
  };
  const connect = AudioNode.prototype.connect;
  AudioNode.prototype.connect = function (to, ...more) {
    if (to instanceof AudioDestinationNode) {
      window.heard = new AnalyserNode(this.context, {fftSize: 32768});
      connect.call(this, window.heard);
    }
    return connect.call(this, to, ...more);
  };
  window.level = () => {
    const samples = new Float32Array(window.heard.fftSize);
    window.heard.getFloatTimeDomainData(samples);
    return Math.sqrt(samples.reduce((sum, sample) => sum + sample * sample, 0) / samples.length);
  };
}

const ok = (text) => console.log(`ok   ${text}`);
const CAPTIONS = `document.getElementById('captions').innerText`;
const LANGUAGE = 'document.documentElement.lang';
const AUDIBLE = `level() > ${LEAST_LEVEL}`;
// Chooses with the keyboard in a list that has the focus.
async function choose(browser, value) {
  await type(browser, 'Home');
  for (let i = 0; i < 10 && await browser.evaluate('document.activeElement.value') !== value; ++i) {
    await type(browser, 'ArrowDown');
  }
  assert.equal(await browser.evaluate('document.activeElement.value'), value);
}

async function visit(browser) {
  const {origin} = server;
  await browser.open(`${origin}/`, `(${prepare})()`);
  await browser.until(`${READY} && document.title.includes('thermopolium')`);
  await screens.take(browser, 'title');
  assert.equal(await browser.evaluate(`[...document.getElementById('language').options].map(({text}) => text).join()`), 'English,Italiano,Latina');
  await focus(browser, 'language');
  await choose(browser, 'it');
  await browser.until(`${LANGUAGE} === 'it' && document.getElementById('go').innerText === 'Inizia con la fotocamera'`);
  ok(`the title page has the show's title and languages`);

  await browser.setCamera(origin, 'denied');
  await focus(browser, 'go');
  await type(browser, 'Enter');
  await browser.until(says('La fotocamera non è consentita'));
  await screens.take(browser, 'refused');
  await browser.setCamera(origin, 'granted');
  await focus(browser, 'go');
  await type(browser, 'Enter');
  await browser.until(PLAYS, 120);
  await browser.until(`${CAPTIONS} !== ''`, 60);
  assert.equal(await browser.evaluate(`document.getElementById('captions').lang`), 'it');
  console.log(`     first caption: ${JSON.stringify(await browser.evaluate(CAPTIONS))}`);
  await browser.until(AUDIBLE, 60);
  ok('captions are in the language that was chosen, and the show is heard');
  await screens.take(browser, 'show');

  // The menu, by keyboard.
  await focus(browser, 'open_menu');
  await type(browser, 'Enter');
  await browser.until(`document.getElementById('menu').open`);
  await screens.take(browser, 'menu');
  await focus(browser, 'volume');
  await type(browser, 'Home');
  await browser.until(`!(${AUDIBLE})`, 30);
  await type(browser, 'End');
  await browser.until(AUDIBLE, 30);
  ok('the volume is changed');
  await focus(browser, 'size');
  await choose(browser, '2');
  await focus(browser, 'contrast');
  await choose(browser, '1');
  await screens.take(browser, 'menu_large');
  await focus(browser, 'descriptions');
  await choose(browser, '1');
  await focus(browser, 'reducedMotion');
  await choose(browser, '1');
  await focus(browser, 'captions');
  await choose(browser, 'la');
  await browser.until(`${LANGUAGE} === 'la'`, 60);
  assert.equal(await browser.evaluate(FOCUSED), 'captions');
  await type(browser, 'Escape');
  await browser.until(`!document.getElementById('menu').open && (${FOCUSED}) === 'open_menu'`);
  await browser.evaluate('window.ahead = 31');
  await browser.until(`${CAPTIONS} !== '' && document.getElementById('captions').lang === 'la'`, 60);
  console.log(`     a caption in another language: ${JSON.stringify(await browser.evaluate(CAPTIONS))}`);
  await browser.until(AUDIBLE, 30);
  ok('the menu works by keyboard, Escape closes it, and languages change while the show goes on');
  await screens.take(browser, 'show_large');

  // Right to left: captions take their own direction, and the page lies the other way round.
  await browser.evaluate(`document.documentElement.dir = 'rtl', document.querySelector('#captions').innerHTML = '<p dir="auto"><b>קופאי</b> ברוכים הבאים</p>'`);
  assert.equal(await browser.evaluate(`getComputedStyle(document.querySelector('#captions p')).direction`), 'rtl');
  const box = JSON.parse(await browser.evaluate(`JSON.stringify(document.getElementById('open_menu').getBoundingClientRect())`));
  assert.ok(box.left < 100, 'the menu is on the left');
  await browser.evaluate(`document.documentElement.dir = 'ltr'`);
  ok('right to left: the menu is on the other side, and captions have their own direction');

  // The camera looks elsewhere.
  await browser.until(`document.getElementById('hint').className === 'look' && document.getElementById('hint').innerText !== ''`, 100);
  await screens.take(browser, 'guide');

  // A hidden page is silent.
  const first = browser.session;
  await browser.open('about:blank', '');
  browser.session = first;
  await browser.until(`heard.context.state === 'suspended'`);
  await browser.until(says('Spectaculum te exspectat'));
  await browser.show(first);
  await press(browser);
  await browser.until(`${PLAYS} && heard.context.state === 'running' && ${AUDIBLE}`, 60);
  ok('a hidden page is silent, and goes on');

  // The end.
  // The story waits while the camera looks elsewhere, and time that passes then does not count.
  await browser.evaluate('window.clock = setInterval(() => window.ahead += 20, 1000)');
  await browser.until(says('Finis est'), 100);
  await browser.evaluate('clearInterval(window.clock)');
  await browser.until(`heard.context.state === 'suspended' && document.getElementById('video').srcObject === null`);
  await screens.take(browser, 'end');
  await focus(browser, 'go');
  await type(browser, 'Enter');
  await browser.until(`${PLAYS} && ${CAPTIONS} !== ''`, 100);
  console.log(`     after the end, from the beginning: ${JSON.stringify(await browser.evaluate(CAPTIONS))}`);
  ok('the story ends with a farewell, without camera and sound, and begins again');

  await browser.evaluate('location.reload()');
  await browser.until(`${READY} && ${LANGUAGE} === 'la' && document.documentElement.dataset.size === '2' && document.documentElement.dataset.contrast === '1'`);
  ok('the browser remembers the choices');

  // A new visitor gets what the system prefers.
  await browser.evaluate('localStorage.clear()');
  await browser.send('Emulation.setEmulatedMedia', {features: [{name: 'prefers-contrast', value: 'more'}, {name: 'prefers-reduced-motion', value: 'reduce'}]});
  const {userAgent} = await browser.send('Browser.getVersion', {}, null);
  await browser.send('Emulation.setUserAgentOverride', {userAgent, acceptLanguage: 'fi,it-CH'});
  await browser.evaluate('location.reload()');
  await browser.until(`${READY} && document.title.includes('thermopolium') && ${LANGUAGE} === 'it'`);
  assert.deepEqual(await browser.evaluate(`[document.documentElement.dataset.size, document.documentElement.dataset.contrast,
    ...['captions', 'reducedMotion'].map((key) => document.querySelector('[data-key=' + key + ']').value)]`), ['0', '1', 'it', '1']);
  ok('a new visitor gets the language, contrast and motion that the system prefers');

  // Without a camera.
  await browser.send('Emulation.setDeviceMetricsOverride', {width: 390, height: 844, deviceScaleFactor: 1, mobile: true});
  await focus(browser, 'without_camera');
  await type(browser, 'Enter');
  await browser.until(`${PLAYS} && ${CAPTIONS} !== '' && ${AUDIBLE}`, 120);
  await screens.take(browser, 'walk');
  // The middle of the picture in a coarse raster, read in the frame in which it was drawn.
  await browser.evaluate(`window.raster = () => new Promise((resolve) => requestAnimationFrame(() => {
    const gl = document.getElementById('lararium').getContext('webgl2');
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const pixels = new Uint8Array(4 * width * height);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    resolve(Array.from({length: 256}, (_, i) => pixels[4 * (Math.floor((i >> 4) * height / 16) * width + Math.floor((i & 15) * width / 16))]));
  }))`);
  const views = await browser.evaluate(`Number(document.getElementById('view').max) + 1`);
  await focus(browser, 'view');
  await type(browser, 'Home');
  await new Promise((resolve) => setTimeout(resolve, 3000));
  const before = await browser.evaluate('raster()');
  await type(browser, 'End');
  await browser.until(`raster().then((now) => now.reduce((sum, value, i) => sum + Math.abs(value - ${JSON.stringify(before)}[i]), 0) / 256 > 10)`, 30);
  assert.equal(await browser.evaluate('asked'), 0);
  ok(`without a camera the show is seen from ${views} places, and the browser is not asked for one`);
}

try {
  await withBrowser(program, work, cameraOptions(camera), visit);
} finally {
  server.close();
}
console.log(`     screenshots: ${screens.shots.join(', ')}`);
