// node page_test.mjs REFERENCE_PROGRAM PAGE CHROMIUM WORK_FOLDER EDITOR PROJECT SCENE.larscene VIDEO AXE
// A visit in Chromium without a screen, from a server of files without special headers: a video stands for the camera.
// Checks the sentences for what stands in the way, every pose against the native tracker's, and that the canvas shows
// the image that was tracked, with people in it. Writes screenshots. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync} from 'node:fs';
import {exportFolder, fileIn, serve, skipWithout} from './needs.mjs';
import {distancePx, pixel} from './poses.mjs';
import {cameraOptions, focus, press, READY, says, Screens, type, withBrowser, writeCamera} from './visitor.mjs';

const [reference, page, program, work, editor, project, scene, video, axe] = process.argv.slice(2);
skipWithout(
  [`${page}/module.wasm`, 'build the preset `web`'], [editor, 'build lararium-editor'],
  [scene, 'run the test acceptance/maquette'], [video, 'set LARARIUM_DATA_DIR'], [program, 'install chromium'],
  ['/usr/bin/ffmpeg', 'install ffmpeg']);
const FRAMES = 30;  // This many images have a pose before the camera looks elsewhere.
// The page misses frames of the camera and sees the video again and again, so its tracker and the native one know the lens
// from different images; the native one begins with a guess.
const MOST_PX = 3;
const MOST_IMAGE_LEVELS = 2;  // The canvas and the image that was tracked differ by this median, of 255.
const LEAST_CHANGED = 0.02;  // People, or the guide, change this share of the picture.

mkdirSync(work, {recursive: true});
execFileSync(reference, [scene, video, work], {stdio: 'inherit'});
const native = JSON.parse(readFileSync(`${work}/reference.json`, 'utf8'));
const {width, height} = native;
const grey = readFileSync(`${work}/frames.grey`);
const camera = `${work}/camera.y4m`;
writeCamera(video, width, height, camera);

const folder = `${work}/folder`;
exportFolder(editor, project, page, folder);
let missing = true;  // The server has no show at first.
// The second body that the page asks for takes its time.
const manifest = JSON.parse(readFileSync(`${folder}/show/manifest.json`, 'utf8'));
const bodies = manifest.cast.map(({human}) => `/show/${manifest.members.find(({name}) => name === human).sha256}`);
const asked = new Set();
let sendBodies;
const sent = new Promise((resolve) => {
  sendBodies = resolve;
});
const server = await serve(async (path) => {
  if (bodies.includes(path) && asked.add(path).size > 1) {
    await sent;
  }
  return missing && path.startsWith('/show/') ? undefined : fileIn(folder, path);
});
const {origin} = server;

// Runs in the page: notes for each image what the tracker said, some pixels of the image, and how the canvas differs
// from it, as soon as the page has drawn it.
const STEP = 10;
function watch(step) {
  window.noted = [];
  const Original = Worker;
  let image;
  const compare = () => {
    const {data, width, height} = image;
    const gl = document.getElementById('lararium').getContext('webgl2');
    const drawn = new Uint8Array(4 * width * height);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, drawn);
    const differences = [];
    const some = [];
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const at = 4 * ((height - 1 - y) * width + x);
        const luminance = 0.299 * drawn[at] + 0.587 * drawn[at + 1] + 0.114 * drawn[at + 2];
        const seen = Math.min(255, Math.max(0, (data[y * width + x] - 16) * 255 / 219));
        differences.push(Math.abs(luminance - seen));
        if (x % step === 0 && y % step === 0) {
          some.push(data[y * width + x]);
        }
      }
    }
    const changed = differences.filter((difference) => difference > 25).length / differences.length;
    differences.sort((a, b) => a - b);
    return {some, changed, median: differences[differences.length >> 1]};
  };
  window.Worker = class extends Original {
    constructor(...options) {
      super(...options);
      // The page's own listener comes first.
      setTimeout(() => this.addEventListener('message', ({data}) => {
        if (data.tracked && document.getElementById('card').hidden) {  // The page ignores what comes after its stop.
          window.noted.push({tracked: data.tracked, milliseconds: performance.now(), ...compare()});
        }
      }));
    }
    postMessage(message, transfer) {
      if (message.image) {
        image = {...message.image, data: message.image.data.slice()};
      }
      super.postMessage(message, transfer);
    }
  };
}

// The part of the video's image that a camera of this width shows, from its left edge on: it cuts both sides off.
const leftOf = (camera) => (width - camera.width) / 2;

// The index of the video's frame, by some pixels of its luminance.
function frameOf({some, tracked}) {
  const left = leftOf(tracked.camera);
  const sums = native.unknown.map((_, i) => {
    let sum = 0;
    let at = 0;
    for (let y = 0; y < height; y += STEP) {
      for (let x = left; x < width - left; x += STEP) {
        sum += Math.abs(some[at++] - grey[i * width * height + y * width + x]);
      }
    }
    return sum;
  });
  return sums.indexOf(Math.min(...sums));
}

function distanceFromNative(frame) {
  const {camera, pose} = frame.tracked;
  assert.equal(camera.height, height);
  const {points, ...expected} = native.unknown[frameOf(frame)];
  const shown = points.filter((point) => {
    const [x] = pixel(expected, expected.camera, point);
    return x >= leftOf(camera) && x < width - leftOf(camera);
  });
  return distancePx({pose, camera: {...camera, cx: camera.cx + leftOf(camera)}}, {points: shown, ...expected});
}

const POSES = 'noted.filter((frame) => frame.tracked.pose).length';
const screens = new Screens(work, axe);

function check(good, text) {
  console.log(`${good ? 'ok  ' : 'MISS'} ${text}`);
  assert.ok(good, text);
}

// Compares what the page has noted with the native tracker.
function checkPoses(noted) {
  const tracked = noted.filter((frame) => frame.tracked.pose !== null);
  const worst = Math.max(...tracked.map(distanceFromNative));
  const followed = tracked.filter((frame) => frame.tracked.followed).length;
  check(tracked.length > 0 && worst <= MOST_PX,
    `${tracked.length} of ${noted.length} images have a pose, ${followed} of them followed; largest distance from native ${worst.toFixed(2)} px (bar ${MOST_PX})`);
}

const share = (changed) => `${(100 * changed).toFixed(1)} %`;

// Keys that reach the drama while the menu's button, the menu or nothing has the focus.
async function checkKeys(browser) {
  await browser.evaluate(`import('./show.js').then(({Show}) => {
    window.keys = [];
    const {pressKey} = Show.prototype;
    Show.prototype.pressKey = function (key) {
      window.keys.push(key);
      pressKey.call(this, key);
    };
  })`);
  await focus(browser, 'open_menu');
  await type(browser, 'k', ' ');
  await browser.until(`document.getElementById('menu').open`);
  await type(browser, 'k', 'Escape');
  await browser.until(`!document.getElementById('menu').open`);
  await browser.evaluate('document.activeElement.blur()');
  await type(browser, ' ', 'ArrowDown', 'Escape', 'Tab');
  const keys = await browser.evaluate('keys.join()');
  check(keys === 'k,space,down,escape', `keys reach the drama but for those that the page needs: ${keys}`);
}

async function visit(browser) {
  await browser.open(`${origin}/`, `(${watch})(${STEP})`);
  await browser.until(READY);
  await screens.take(browser, 'title');
  await browser.setCamera(origin, 'denied');
  await press(browser);
  await browser.until(says('not allowed for this page'));
  await screens.take(browser, 'refused');
  console.log('ok   a refused camera has its sentence');

  await browser.setCamera(origin, 'granted');
  await press(browser);
  await browser.until(says('The show does not arrive'));
  console.log('ok   a missing show has its sentence');

  missing = false;
  await press(browser);
  assert.ok(bodies.length > 1);
  await browser.until(`document.getElementById('lararium').dataset.people === '1'`, 200);
  await browser.until(`noted.filter((frame) => frame.tracked.pose).length > 3`, 100);
  assert.equal(await browser.evaluate(`document.getElementById('lararium').dataset.shows`), 'guide');
  console.log('ok   the show plays with the first person while the next one is under way');
  sendBodies();
  await browser.until(`document.getElementById('lararium').dataset.shows === 'show'`, 200);
  assert.equal(await browser.evaluate(`document.getElementById('lararium').dataset.people`), `${bodies.length}`);
  await browser.until(`${POSES} >= ${FRAMES}`, 200);
  await screens.take(browser, 'show');
  await checkKeys(browser);
  await browser.until(`noted.at(-1).milliseconds - noted.findLast((frame) => frame.tracked.pose).milliseconds > 3000`, 100);
  await screens.take(browser, 'guide');
  const before = await browser.evaluate(POSES);
  await browser.until(`${POSES} > ${before}`, 100);

  await browser.setCamera(origin, 'denied');
  await browser.until(says('The camera has stopped'));
  await browser.setCamera(origin, 'granted');
  await press(browser);
  const count = await browser.evaluate('noted.length');
  await browser.until(`noted.length >= ${count + 3} && document.getElementById('card').hidden`);
  console.log('ok   a camera that was taken away has its sentence, and the show goes on');

  const noted = await browser.evaluate('noted');
  checkPoses(noted);
  const shown = noted.filter((frame) => frame.tracked.pose);
  const median = Math.max(...shown.map((frame) => frame.median));
  check(median <= MOST_IMAGE_LEVELS,
    `canvas against the image that was tracked: median difference at most ${median.toFixed(1)} of 255 (bar ${MOST_IMAGE_LEVELS})`);
  const people = Math.max(...shown.map((frame) => frame.changed));
  check(noted[0].changed < LEAST_CHANGED / 4 && people >= LEAST_CHANGED, `people and shadows change up to ${share(people)} ` +
    `of a picture (least ${share(LEAST_CHANGED)}), and the very first picture, without them, ${share(noted[0].changed)}`);
  const guided = Math.max(...noted.filter((frame) => !frame.tracked.pose).map((frame) => frame.changed));
  check(guided >= LEAST_CHANGED, `where the camera looks elsewhere, the guide changes ${share(guided)} of the picture`);
  const intervals = shown.slice(5, FRAMES).map((frame, i) => frame.milliseconds - shown[i + 4].milliseconds).sort((a, b) => a - b);
  console.log(`     from picture to picture, drawn by the processor: ${Math.round(intervals[intervals.length >> 1])} ms (p50)`);

  // The device is turned: the camera gives images of another size from now on.
  await browser.evaluate('noted.length = 0, document.getElementById("video").srcObject.getVideoTracks()[0].applyConstraints({width: 360, height: 480})');
  await browser.until(`noted.filter((frame) => frame.tracked.pose && frame.tracked.camera.width === 360).length >= 8`, 100);
  await screens.take(browser, 'turned');
  checkPoses(await browser.evaluate('noted.filter((frame) => frame.tracked.camera.width === 360)'));

  // A second tab, whose browser has no planes of images.
  const first = browser.session;
  await browser.open(`${origin}/`, `delete globalThis.VideoFrame; (${watch})(${STEP})`);
  const second = browser.session;
  browser.session = first;
  await browser.until(says('The show waits for you'));
  await browser.show(first);
  await browser.evaluate('noted.length = 0');
  await press(browser);
  await browser.until('noted.length >= 3', 100);
  console.log('ok   a hidden page lets the camera go and says so, and the show goes on');
  await browser.show(second);
  await browser.until(READY);
  await browser.evaluate('addEventListener("keydown", () => window.pressed = performance.now(), true)');
  await focus(browser, 'go');
  await type(browser, 'Enter');
  await browser.until(`${POSES} >= 3`, 100);
  checkPoses(await browser.evaluate('noted'));
  console.log('ok   a keyboard starts the show');
  console.log(`     from the start to the first picture, the show being on this machine: ${Math.round(await browser.evaluate('noted[0].milliseconds - pressed'))} ms`);
  await browser.evaluate(`document.getElementById('lararium').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()`);
  await browser.until(says('The show cannot go on'));
  await press(browser);
  await browser.until(says('Point the camera at this place'));
  console.log('ok   a lost drawing context has its sentence, and the page is loaded again');
}

try {
  await withBrowser(program, work, cameraOptions(camera), visit);
  await withBrowser(program, work, [], async (browser) => {
    await browser.setCamera(origin, 'granted');
    await browser.open(`${origin}/`, '');
    await browser.until(READY);
    await press(browser);
    await browser.until(says('no camera that a page can use'));
    console.log('ok   a device without a camera has its sentence');
  });
} finally {
  server.close();
}
console.log(`     screenshots: ${screens.shots.join(', ')}`);
