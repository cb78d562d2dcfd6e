// node show_test.mjs REFERENCE_PROGRAM WEB_PROGRAM NODE WORK_FOLDER SHOW FRAMES SECONDS
// Stages a show in WebAssembly and natively in one thread, and compares where people stand, how they are posed, what
// is lit and which captions are shown. Prints every figure beside its bar; times are printed only, because they depend
// on what else the machine does. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync} from 'node:fs';
import {skipWithout} from './needs.mjs';

const [reference, program, node, work, show, frames, seconds] = process.argv.slice(2);
skipWithout([program, 'build the preset `web`'], [show, 'run ./demo or the test acceptance/maquette']);
// Largest difference that is allowed: metres; of light a share, or of dim light one of light of strength 1. The two
// standard libraries' sines differ in their last bit, which hair and cloth carry on from frame to frame and enlarge where
// they touch the body. Native light uses fused multiplication, which WebAssembly lacks, and rounds to 16 bits on its way;
// light on cloth also turns with it.
const BARS = {people: 3e-6, things: 1e-6, faces: 1e-6, hair: 1e-3, cloth: 1e-2, light: 2e-2};

function run(command, ...before) {
  const folder = `${work}/${before.length === 0 ? 'native' : 'web'}`;
  mkdirSync(folder, {recursive: true});
  const times = [1, 2].map(() => {  // Other work of the machine makes times longer.
    execFileSync(command, [...before, show, frames, seconds, folder], {stdio: 'inherit'});
    return JSON.parse(readFileSync(`${folder}/frames.json`, 'utf8')).frames.map((frame) => frame.milliseconds);
  });
  const numbers = {};
  for (const kind of Object.keys(BARS)) {
    const bytes = readFileSync(`${folder}/${kind}.f32`);
    numbers[kind] = new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4);
  }
  const read = JSON.parse(readFileSync(`${folder}/frames.json`, 'utf8'));
  read.frames.forEach((frame, i) => frame.milliseconds = Math.min(times[0][i], times[1][i]));
  return {numbers, ...read};
}

const quantile = (values, q) => [...values].sort((a, b) => a - b)[Math.round(q * (values.length - 1))];

const natively = run(reference);
const web = run(node, program);

assert.equal(web.frames.length, Number(frames));
assert.deepEqual(web.errors, natively.errors);
const without_time = ({milliseconds, ...frame}) => frame;
web.frames.forEach((frame, i) => assert.deepEqual(without_time(frame), without_time(natively.frames[i]), `frame ${i}`));
const most_people = Math.max(...web.frames.map((frame) => frame.people.length));
const captions = new Set(web.frames.flatMap((frame) => frame.captions.map((caption) => caption.text)));
assert.ok(most_people > 0 && web.numbers.people.length > 0);
console.log(`ok   ${frames} frames, up to ${most_people} people, ${captions.size} captions: all alike`);

let missed = 0;
for (const [kind, bar] of Object.entries(BARS)) {
  const [a, b] = [web.numbers[kind], natively.numbers[kind]];
  assert.equal(a.length, b.length, kind);
  if (a.length === 0) {
    console.log(`     ${kind}: the show has none`);
    continue;
  }
  let worst = 0;
  let equal = 0;
  for (let i = 0; i < a.length; ++i) {
    assert.ok(Number.isFinite(a[i]), kind);
    worst = Math.max(worst, Math.abs(a[i] - b[i]) / (kind === 'light' ? Math.max(1, Math.abs(b[i])) : 1));
    equal += a[i] === b[i] ? 1 : 0;
  }
  missed += worst <= bar ? 0 : 1;
  console.log(`${worst <= bar ? 'ok  ' : 'MISS'} ${kind}: ${a.length} numbers, ${(100 * equal / a.length).toFixed(1)} % ` +
    `equal bit for bit, largest difference ${worst} (bar ${bar})`);
}

const full = (run) => run.frames.filter((frame, i) => i >= 10 && frame.people.length === most_people).map((frame) => frame.milliseconds);
const described = (times) => `${quantile(times, 0.5).toFixed(2)} / ${quantile(times, 0.95).toFixed(2)} ms`;
console.log(`     a frame of ${most_people} people, better of two runs (p50 / p95 of ${full(web).length}): WebAssembly ${described(full(web))}, ` +
  `native in one thread ${described(full(natively))}`);
console.log(`     loading ${Math.round(web.loading_milliseconds)} ms, native ${Math.round(natively.loading_milliseconds)} ms`);
assert.equal(missed, 0);
