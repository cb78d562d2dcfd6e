// node lines_test.mjs PROGRAM
// Plays spoken lines at a page's uneven pace in Node, where plain objects that note times stand for Web Audio, whose clock
// runs a little fast. Checks that every line is in time with the drama, and is not begun again. Status 77: something that
// the test needs is absent.
import assert from 'node:assert/strict';
import {createRequire} from 'node:module';
import {skipWithout} from './needs.mjs';

const [program] = process.argv.slice(2);
skipWithout([program, 'build the preset `web`']);
const SECONDS = 12;
const EVERY = 1.3;  // Seconds from line to line, as in play_lines.cc.
const LATENCY = 0.04;
const FAST = 1.002;  // The sound card's clock over the machine's.
// Sound that leads or lags by more than this is noticed (ITU-R BT.1359-1), seconds.
const MOST_LEAD = 0.045;
const MOST_LAG = 0.125;

const now = () => Number(process.hrtime.bigint()) / 1e9;  // The program has the same clock.
const start = now();
const context = {sampleRate: 48000, outputLatency: LATENCY, get currentTime() { return FAST * (now() - start); }};
const notes = [];
class Param {
  setValueAtTime() {}
  linearRampToValueAtTime() {}
}
class Node {
  constructor(on, {buffer, loop} = {}) {
    Object.assign(this, {context, buffer, loop, gain: new Param(), positionX: new Param(), positionY: new Param(), positionZ: new Param()});
  }
  connect(to) { return to; }
  disconnect() {}
  start(when, offset) { notes.push({buffer: this.buffer, loop: this.loop, when: Math.max(when, context.currentTime), offset}); }
  stop() {}
}
for (const name of ['GainNode', 'PannerNode', 'BiquadFilterNode', 'ConvolverNode', 'DynamicsCompressorNode', 'AudioBufferSourceNode']) {
  globalThis[name] = class extends Node {};
}
globalThis.AudioBuffer = class {
  constructor({length, sampleRate}) {
    Object.assign(this, {length, duration: length / sampleRate});
  }
  getChannelData() { return new Float32Array(this.length); }
};

const said = [];
const print = (text) => said.push(text);
const module = await createRequire(import.meta.url)(program)({print, printErr: print, audioOut: {context}});
assert.equal(module.callMain([String(SECONDS)]), 0, said.join('\n'));

const begin = Number(said[0]) - start;
const lines = notes.filter(({loop}) => !loop);
const expected = Math.ceil(SECONDS / EVERY);
// The position in a line that is heard, less the one that the drama has then.
const errors = lines.map(({when, offset}) => {
  const heard = when / FAST + LATENCY - begin;
  const line = Math.round((heard - offset) / EVERY);
  return offset - (heard - line * EVERY);
});
const [lead, lag] = [Math.max(...errors), -Math.min(...errors)];
const good = lines.length === expected && lead <= MOST_LEAD && lag <= MOST_LAG;
console.log(`${good ? 'ok  ' : 'MISS'} ${lines.length} lines were begun (${expected} spoken); sound lags by ${Math.round(-1000 * lead)} to ` +
  `${Math.round(1000 * lag)} ms (bars ${-1000 * MOST_LEAD} and ${1000 * MOST_LAG})`);
assert.ok(good);
