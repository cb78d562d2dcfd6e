// Measures how well a device plays the show, and writes a report as text.
import {openCamera, readImage} from './camera.js';
import {compilePrograms, Folder} from './folder.js';
import {Place} from './place.js';
import {Show, SHOW} from './show.js';

const CAMERA_SECONDS = 10;
const DRAWN_PICTURES = 20;
const FRAME_SECONDS = 1 / 30;
const LANGUAGES = {spoken: '', captions: '', read: ''};  // The author's choice.
// A picture in which no person is visible is the keyframe itself, but for rounding.
const LEAST_DECIBELS = 40;

const element = (id) => document.getElementById(id);
const [go, doing, canvas, video, report, copy] = ['go', 'doing', 'lararium', 'video', 'report', 'copy'].map(element);

const lines = [];
function say(name, value) {
  lines.push(`${name}: ${value}`);
  report.value = lines.join('\n');
}

const sorted = (values) => [...values].sort((a, b) => a - b);
const quantile = (values, share) => sorted(values)[Math.round(share * (values.length - 1))];
const spread = (values) => values.length === 0 ? 'none'
  : `${quantile(values, 0.5).toFixed(1)} ms, at most ${quantile(values, 0.95).toFixed(1)} ms for 95 %`;
const since = (start) => performance.now() - start;
const nextTask = () => new Promise((resolve) => setTimeout(resolve));

// --- The device

function describeDevice() {
  say('time', new Date().toISOString());
  say('browser', navigator.userAgent);
  say('screen', `${screen.width}x${screen.height}, ${devicePixelRatio} pixels each`);
  say('processor cores', navigator.hardwareConcurrency ?? 'not told');
  say('memory of the device', navigator.deviceMemory === undefined ? 'not told' : `${navigator.deviceMemory} GB or more`);
  say('planes of camera images', globalThis.VideoFrame === undefined ? 'no: images are read through a canvas, which is slower' : 'yes');
}

function describeDrawing() {
  const gl = canvas.getContext('webgl2');
  const named = gl.getExtension('WEBGL_debug_renderer_info');
  say('drawing device', gl.getParameter(named === null ? gl.RENDERER : named.UNMASKED_RENDERER_WEBGL));
}

// --- Loading

async function load() {
  const start = performance.now();
  const folder = await Folder.open();
  say('show', folder.about.title);
  const [program, trackerProgram] = await compilePrograms();
  const show = await folder.openShow(Show, program);
  await folder.supply(show, SHOW, LANGUAGES);
  say('files and programs', `${(since(start) / 1000).toFixed(1)} s`);
  const reading = performance.now();
  const place = new Place(show.maps(), trackerProgram);
  await nextTask();
  show.load(SHOW, LANGUAGES);
  await place.ready;
  place.setOccluders(show.occluders());
  say('reading the show', `${(since(reading) / 1000).toFixed(1)} s`);
  return {show, place};
}

// --- Drawing

// The pixels that were drawn last. Call it in the task that has drawn.
function readCanvas() {
  const {width, height} = canvas;
  const copied = new OffscreenCanvas(width, height).getContext('2d', {willReadFrequently: true});
  copied.drawImage(canvas, 0, 0);
  return copied.getImageData(0, 0, width, height).data;
}

// Draws a keyframe of the map, and waits until the graphics device has done so.
function drawView(show, view, seconds, shown) {
  Object.assign(canvas, show.viewSize(view));
  show.drawView(view, seconds, 0, shown);
  const gl = canvas.getContext('webgl2');
  const bound = gl.getParameter(gl.READ_FRAMEBUFFER_BINDING);
  gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  gl.bindFramebuffer(gl.READ_FRAMEBUFFER, bound);
}

// Without visible people the picture must be the keyframe; with them it must not.
async function testDrawing(show) {
  const view = Math.floor(show.viewCount / 2);
  let seconds = 0;
  drawView(show, view, seconds, 0);
  const empty = readCanvas();
  const expected = show.viewPicture(view);
  const squares = expected.reduce((sum, grey, i) => sum + (grey - empty[4 * i + 1]) ** 2, 0);
  const decibels = 10 * Math.log10(255 ** 2 / Math.max(squares / expected.length, 1e-9));
  say('picture without people', `${decibels >= LEAST_DECIBELS ? 'good' : 'BAD'}, ${decibels.toFixed(1)} dB from the map's (${LEAST_DECIBELS} are good)`);
  const times = [];
  for (let i = 0; i < DRAWN_PICTURES; ++i) {
    seconds += FRAME_SECONDS;
    const start = performance.now();
    drawView(show, view, seconds, 1);
    times.push(since(start));
    if (i + 1 < DRAWN_PICTURES) {
      await nextTask();
    }
  }
  const people = readCanvas();
  let changed = 0;
  for (let i = 0; i < people.length; i += 4) {
    changed += Math.abs(people[i] - empty[i]) + Math.abs(people[i + 1] - empty[i + 1]) + Math.abs(people[i + 2] - empty[i + 2]) > 24;
  }
  const share = changed / (people.length / 4);
  say('picture with people', `${share > 0 ? 'good' : 'BAD'}, they change ${(100 * share).toFixed(1)} % of it`);
  say('one picture, staged and drawn', spread(times));
  return seconds;
}

// --- Camera

function describeCamera(track) {
  const {width, height, frameRate} = track.getSettings();
  say('camera', `${track.label || 'not named'}, ${width}x${height}, ${frameRate === undefined ? 'rate not told' : `${Math.round(frameRate)} images a second`}`);
  const able = track.getCapabilities?.() ?? {};
  if (able.width !== undefined) {
    say('camera at most', `${able.width.max}x${able.height.max}, ${Math.round(able.frameRate?.max ?? 0)} images a second`);
  }
}

const nextImage = () => new Promise((resolve, reject) => {
  const missing = setTimeout(() => reject(new Error('the camera sends no images')), 1000 * CAMERA_SECONDS);
  video.requestVideoFrameCallback((now, image) => {
    clearTimeout(missing);
    resolve(image);
  });
});

async function testCamera({show, place}, begun) {
  const stream = await openCamera();
  try {
    const [track] = stream.getVideoTracks();
    describeCamera(track);
    video.srcObject = stream;
    await video.play();
    show.forgetPose();
    const times = {reading: [], luminance: [], tracking: [], drawing: []};
    const states = {};
    let tracked;
    let format;
    const start = performance.now();
    let images = 0;
    for (; since(start) < 1000 * CAMERA_SECONDS; ++images) {
      await nextImage();
      const began = performance.now();
      const pixels = await readImage(video);
      times.reading.push(since(began));
      ({format} = pixels);
      const copying = performance.now();
      const luminance = show.setImage(pixels);
      times.luminance.push(since(copying));
      const asking = performance.now();
      const answer = new Promise((resolve, reject) => Object.assign(place, {ontracked: resolve, onerror: reject}));
      place.track(images, luminance, since(start) / 1000);
      const found = await answer;
      times.tracking.push(since(asking));
      states[found.tracked.state] = (states[found.tracked.state] ?? 0) + 1;
      tracked = found.tracked.pose ? found.tracked : tracked;
      Object.assign(canvas, {width: pixels.width, height: pixels.height});
      const drawing = performance.now();
      show.draw(found.tracked, found.seen, begun + since(start) / 1000, 0, 1);
      times.drawing.push(since(drawing));
    }
    say('images', `${images} in ${CAMERA_SECONDS} s, as ${format}`);
    for (const [name, values] of Object.entries(times)) {
      say(`an image, ${name}`, spread(values));
    }
    say('states', Object.entries(states).map(([state, count]) => `${count} ${state}`).join(', '));
    if (tracked === undefined) {
      say('place', 'NOT FOUND: was the camera pointed at it?');
    } else {
      const {width, fx} = tracked.camera;
      say('place', `found, confidence ${tracked.confidence.toFixed(3)}`);
      say('lens', `${(360 / Math.PI * Math.atan(width / (2 * fx))).toFixed(1)} degrees wide, focal length ${(fx / width).toFixed(4)} of the width`);
    }
  } finally {
    stream.getTracks().forEach((track) => track.stop());
    video.srcObject = null;
  }
}

function describeMemory(show) {
  const mib = (bytes) => `${Math.round(bytes / 2 ** 20)} MiB`;
  say('memory of the show', mib(show.module.HEAPU8.length));
  say('memory of JavaScript', performance.memory === undefined ? 'not told' : mib(performance.memory.usedJSHeapSize));
}

// --- The test

async function test() {
  go.disabled = true;
  copy.disabled = true;
  lines.length = 0;
  try {
    describeDevice();
    doing.textContent = 'Loading the show…';
    const loaded = await load();
    doing.textContent = 'Drawing…';
    await nextTask();
    const seconds = await testDrawing(loaded.show);
    describeDrawing();
    doing.textContent = 'Point the camera at the place…';
    await testCamera(loaded, seconds);
    describeMemory(loaded.show);
    doing.textContent = 'Done. Copy the report, and send it to the people who look after the show.';
  } catch (error) {
    const reason = error?.message ?? String(error);
    say('ended early', reason);
    doing.textContent = `The test ended early: ${reason}`;
  }
  copy.disabled = false;
  go.textContent = 'Load the page again';
  go.disabled = false;
  go.onclick = () => location.reload();
}

go.onclick = test;
copy.onclick = async () => {
  report.select();
  await navigator.clipboard.writeText(report.value).then(
    () => doing.textContent = 'The report is copied.',
    () => doing.textContent = 'The report is selected: copy it with the browser\'s menu.');
};
