// node sound_test.mjs REFERENCE_PROGRAM WEB_FOLDER CHROMIUM WORK_FOLDER
// Web Audio in Chromium mixes the scenes of render_sound.cc into memory, and OpenAL does natively; levels, sides, times and
// the room's answer are compared. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {Chromium} from './chromium.mjs';
import {serve, skipWithout} from './needs.mjs';

const [reference, web, chromium, work] = process.argv.slice(2);
skipWithout([`${web}/render_sound.wasm`, 'build the preset `web`'], [chromium, 'install chromium']);
const RATE = 48000;
const SCENES = ['left', 'right', 'front', 'far', 'occluded', 'turned away', 'in the head', 'stream', 'ambience', 'ambience under speech', 'click'];
const REVERBS = {none: 0, 'stone room': 3, corridor: 4, hall: 5, vault: 6, courtyard: 7};  // Numbers of stage::Reverb.
// Ears of the two systems were measured on different heads.
const MOST_EAR_DB = 5;
const MOST_CHANGE_DB = 1.5;  // Distance, occlusion and the like are the project's own numbers.
const MOST_REVERB_DB = 6;
const MOST_LATE_MS = 15;

async function mix(seconds, rate, reverb) {
  const said = [];
  const print = (text) => said.push(text);
  try {
    const context = new OfflineAudioContext(2, seconds * rate, rate);
    const program = await createProgram({print, printErr: print, audioOut: context.destination});
    said.push(`status ${program.callMain(['/samples', String(reverb)])}`);
    const buffer = await context.startRendering();
    const bytes = new Uint8Array(Float32Array.from({length: 2 * buffer.length},
      (_, i) => buffer.getChannelData(i % 2)[i >> 1]).buffer);
    let text = '';
    for (let i = 0; i < bytes.length; i += 32768) {
      text += String.fromCharCode(...bytes.subarray(i, i + 32768));
    }
    window.samples = btoa(text);
  } catch (error) {
    said.push(`${error}`);
  }
  window.said = said.join('\n');
}

async function inBrowser(reverbs) {
  const server = await serve((path) => path === '/' ? `${work}/sound.html` : `${web}${path}`);
  const browser = new Chromium(chromium, work, []);
  try {
    await browser.open(`${server.origin}/`, '');
    await browser.until('window.createProgram !== undefined');
    const mixed = [];
    for (const reverb of reverbs) {
      await browser.evaluate(`(${mix})(${SCENES.length + 1}, ${RATE}, ${reverb})`);
      const said = await browser.evaluate('window.said');
      assert.ok(said.includes('status 0'), said);
      const bytes = Buffer.from(await browser.evaluate('window.samples'), 'base64');
      mixed.push(new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)));
    }
    return mixed;
  } finally {
    await browser.close();
    server.close();
  }
}

const db = (ratio) => 20 * Math.log10(Math.max(ratio, 1e-9));
function rms(samples, ear, from, to) {
  let sum = 0;
  for (let i = Math.round(from * RATE); i < to * RATE; ++i) {
    sum += samples[2 * i + ear] ** 2;
  }
  return Math.sqrt(sum / ((to - from) * RATE));
}
// The level of a tone, by the algorithm of Goertzel.
function tone(samples, hertz, from, to) {
  let [re, im] = [0, 0];
  for (let i = Math.round(from * RATE); i < to * RATE; ++i) {
    const phase = 2 * Math.PI * hertz * i / RATE;
    re += samples[2 * i] * Math.cos(phase);
    im += samples[2 * i] * Math.sin(phase);
  }
  return Math.hypot(re, im) / ((to - from) * RATE);
}
const both = (samples, scene, from = 0.3, to = 0.8) =>
  db(Math.hypot(rms(samples, 0, scene + from, scene + to), rms(samples, 1, scene + from, scene + to)));
function onset(samples, from) {
  let i = Math.round(from * RATE);
  while (Math.abs(samples[2 * i]) < 0.02) {
    ++i;
  }
  return i / RATE;
}

let missed = 0;
function compare(what, browser, native, most, unit = 'dB') {
  const good = Math.abs(browser - native) <= most;
  missed += good ? 0 : 1;
  console.log(`${good ? 'ok  ' : 'MISS'} ${what}: browser ${browser.toFixed(1)}, native ${native.toFixed(1)} ${unit} (bar ${most})`);
}

mkdirSync(work, {recursive: true});
writeFileSync(`${work}/sound.html`, '<!doctype html><title>sound</title><script src="/render_sound.js"></script>');
const inNative = (reverb) => {
  execFileSync(reference, [`${work}/samples.f32`, String(reverb)]);
  const file = readFileSync(`${work}/samples.f32`);
  return new Float32Array(file.buffer.slice(file.byteOffset, file.byteOffset + file.length));
};
const rooms = Object.values(REVERBS);
const [[native, ...nativeRooms], [browser, ...browserRooms]] = [rooms.map(inNative), await inBrowser(rooms)];
assert.equal(browser.length, native.length);

const sides = (samples, scene) => db(rms(samples, 0, scene + 0.3, scene + 0.8) / rms(samples, 1, scene + 0.3, scene + 0.8));
for (const scene of [0, 1]) {
  compare(`${SCENES[scene]}: left over right`, sides(browser, scene), sides(native, scene), 2 * MOST_EAR_DB);
  assert.ok(Math.abs(sides(browser, scene)) > 3 && Math.sign(sides(browser, scene)) === Math.sign(sides(native, scene)));
}
for (const scene of [0, 1, 2, 3, 4, 5, 6, 7, 8]) {
  compare(`${SCENES[scene]}: level`, both(browser, scene), both(native, scene), MOST_EAR_DB);
}
// The noise is the same in all scenes, so that their ratio at a frequency is that of the filters.
for (const scene of [3, 4, 5]) {
  for (const hertz of [500, 5000, 10000]) {
    const over = (samples) => db(tone(samples, hertz, scene + 0.3, scene + 0.8) / tone(samples, hertz, 2.3, 2.8));
    compare(`${SCENES[scene]} over front at ${hertz} Hz`, over(browser), over(native), MOST_CHANGE_DB);
  }
}
const ducked = (samples) => db(tone(samples, 400, 9.5, 9.8) / tone(samples, 400, 8.5, 8.8));
compare('ambience under speech over ambience alone', ducked(browser), ducked(native), MOST_CHANGE_DB);
assert.ok(ducked(browser) < -6, 'speech lowers ambience');
compare('beginning of the click', 1000 * (onset(browser, 10.05) - 10.25), 1000 * (onset(native, 10.05) - 10.25), MOST_LATE_MS, 'ms');
compare('beginning of the noise on the left', 1000 * (onset(browser, 0) - 0), 1000 * (onset(native, 0) - 0), MOST_LATE_MS, 'ms');
// The room's answer is what is added to the dry click.
for (const [i, name] of Object.keys(REVERBS).slice(1).entries()) {
  for (const [part, from, to] of [['early', 0.3, 0.5], ['late', 0.6, 1.2]]) {
    compare(`${name}: ${part} answer to a click`, both(browserRooms[i], 10, from, to), both(nativeRooms[i], 10, from, to), MOST_REVERB_DB);
  }
}
const levels = Array.from({length: 10}, (_, i) => both(browser, 7, 0.2 + 0.06 * i, 0.26 + 0.06 * i));
const seam = Math.max(...levels) - Math.min(...levels);
console.log(`${seam < 0.5 ? 'ok  ' : 'MISS'} the stream goes on without a gap: its level changes by ${seam.toFixed(2)} dB (bar 0.5)`);
assert.ok(missed === 0 && seam < 0.5);
