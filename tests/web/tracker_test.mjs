// node tracker_test.mjs REFERENCE_PROGRAM PACKAGE SCENE.larscene VIDEO WORK_FOLDER
// Tracks a video with the package lararium-tracker and compares every pose with the native tracker's. Prints
// every figure beside its bar; times are printed only, because they depend on what else the machine does.
// Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {pathToFileURL} from 'node:url';
import {skipWithout} from './needs.mjs';
import {distancePx, pixel} from './poses.mjs';

const [reference, folder, scene, video, work] = process.argv.slice(2);
skipWithout(
  [`${folder}/module.wasm`, 'build the preset `web`'], [scene, 'run the test acceptance/maquette'],
  [video, 'set LARARIUM_DATA_DIR']);
const MOST_PX = 1e-6;

execFileSync(reference, [scene, video, work], {stdio: 'inherit'});
const native = JSON.parse(readFileSync(`${work}/reference.json`, 'utf8'));
const pixels = readFileSync(`${work}/frames.grey`);
const maps = [readFileSync(scene)];
const {projectionMatrix, Searcher, Tracker, viewMatrix} = await import(pathToFileURL(`${folder}/lararium-tracker.js`));
const {width, height} = native;
const image = (i) => ({data: pixels.subarray(i * width * height, (i + 1) * width * height), width, height});

function quantile(values, q) {
  return [...values].sort((a, b) => a - b)[Math.round(q * (values.length - 1))];
}

function time(work) {
  const start = performance.now();
  const result = work();
  return [result, performance.now() - start];
}

const tenths = (ms) => ms.toFixed(2);

async function trackAll(options, expected, each = () => {}) {
  const tracker = await Tracker.create({maps, ...options});
  let worst = 0;
  const times = {first: [], followed: [], natively: []};  // [frames]
  if (options.occluder !== undefined) {
    tracker.addOccluder(options.occluder);
  }
  expected.forEach((native_frame, i) => {
    each(tracker, i);
    const [tracked, ms] = time(() => tracker.track(image(i), native.seconds[i]));
    assert.equal(tracked.state === 'tracking', native_frame.rotation !== undefined, `frame ${i}`);
    (tracked.followed ? times.followed : times.first).push(ms);
    if (tracked.followed) {
      times.natively.push(native_frame.milliseconds);
    }
    if (i === 0 && options.intrinsics !== undefined && options.occluder === undefined) {
      assert.deepEqual(tracked, warmed);
    }
    if (tracked.pose) {
      // The reference has every eighth point.
      assert.equal(Math.ceil(tracker.seen().length / 3 / 8), native_frame.points.length, `frame ${i}`);
      assert.equal(tracked.followed, native_frame.followed, `frame ${i}`);
      assert.equal(tracked.inliers, native_frame.inliers, `frame ${i}`);
      worst = Math.max(worst, distancePx(tracked, native_frame));
    }
  });
  const memory = tracker.module.HEAPU8.length / 2 ** 20;
  tracker.close();
  return {worst, times, memory};
}

// The first tracker of this process, whose code the browser has not compiled for speed yet.
const cold = await Tracker.create({maps, intrinsics: native.camera});
const [, warmUpMs] = time(() => cold.warmUp());
const [warmed, firstMs] = time(() => cold.track(image(0), native.seconds[0]));
cold.close();

assert.ok(native.known.length >= 150 && native.known.every((frame) => frame.points?.length > 4));
const known = await trackAll({intrinsics: native.camera}, native.known);
for (let again = 0; again < 2; ++again) {  // Other work of the machine makes times longer.
  const {times} = await trackAll({intrinsics: native.camera}, native.known);
  known.times.followed = known.times.followed.map((ms, i) => Math.min(ms, times.followed[i]));
}
const unknown = await trackAll({}, native.unknown);
const found = await trackAll({intrinsics: native.camera}, native.found, (tracker) => tracker.relocalize());
const occluder = {positions: Float32Array.from(native.occluder.positions), indices: Uint32Array.from(native.occluder.indices)};
const hidden = await trackAll({intrinsics: native.camera, occluder}, native.hidden);
for (const [name, {worst}] of Object.entries({known, unknown, found, hidden})) {
  console.log(`${worst <= MOST_PX ? 'ok  ' : 'MISS'} ${name}: largest distance from native ${worst} px (bar ${MOST_PX})`);
}
console.log(`     very first pose ${tenths(firstMs)} ms after ${tenths(warmUpMs)} ms of warming up, warm ${tenths(quantile(found.times.first, 0.5))} ms, ` +
  `native ${tenths(quantile(native.found.map((f) => f.milliseconds), 0.5))} ms`);
{
  const {times, memory} = known;
  console.log(`     followed frame, best of three runs: ${tenths(quantile(times.followed, 0.5))} / ${tenths(quantile(times.followed, 0.95))} ms, ` +
    `native ${tenths(quantile(times.natively, 0.5))} / ${tenths(quantile(times.natively, 0.95))} ms (p50 / p95), ` +
    `ratio ${(quantile(times.followed, 0.5) / quantile(times.natively, 0.5)).toFixed(2)}; memory ${memory} MiB`);
}
assert.ok([known, unknown, found, hidden].every(({worst}) => worst <= MOST_PX));

// A second worker's search: as two instances, whose messages are cloned as postMessage does.
const tracker = await Tracker.create({maps, intrinsics: native.camera, postSearches: true});
const searcher = await Searcher.create({maps});
let posted = 0;
let answer = null;
let slowest = 0;
native.known.forEach((expected, i) => {
  const [tracked, ms] = time(() => tracker.track(image(i), native.seconds[i]));
  assert.equal(tracked.state, 'tracking', `frame ${i}`);
  assert.ok(distancePx(tracked, expected) < 1, `frame ${i}`);
  slowest = i === 0 ? 0 : Math.max(slowest, ms);
  if (answer !== null) {
    tracker.giveAnswer(answer);
    answer = null;
  }
  const search = tracker.takeSearch();
  if (search !== null) {
    assert.equal(tracker.takeSearch(), null);
    answer = structuredClone(searcher.find(structuredClone(search)));
    ++posted;
  }
});
assert.equal(posted, 2);  // Every 60 frames.
assert.throws(() => tracker.giveAnswer(Float64Array.of(1, 2, 3)), /search message: is damaged/);
console.log(`ok   ${posted} searches by another instance; slowest followed frame meanwhile ${tenths(slowest)} ms`);

// Matrices for WebGL put a point where the pose and the lens without distortion put it.
const {pose, camera} = (() => {
  const first = native.known[0];
  return {pose: first, camera: {...first.camera, k1: 0, k2: 0, p1: 0, p2: 0}};
})();
const transformed = (m, v) => [0, 1, 2, 3].map((row) => v.reduce((sum, value, column) => sum + m[4 * column + row] * value, 0));
for (const point of pose.points) {
  const clip = transformed(projectionMatrix(camera, 0.1, 100), transformed(viewMatrix(pose), [...point, 1]));
  const [x, y] = pixel(pose, camera, point);
  assert.ok(Math.abs((clip[0] / clip[3] + 1) / 2 * width - 0.5 - x) < 1e-9);
  assert.ok(Math.abs((1 - clip[1] / clip[3]) / 2 * height - 0.5 - y) < 1e-9);
}

// Errors say what to do.
await assert.rejects(Tracker.create({maps: [new Uint8Array(100)]}), /map: .+; /);
const empty = await Tracker.create({maps: []});
assert.throws(() => empty.track(image(0), 0), /add a map before the first image/);
assert.throws(() => tracker.track({data: pixels.subarray(0, 99), width, height}, 0), RangeError);
assert.throws(() => tracker.addOccluder({...occluder, indices: Uint32Array.of(0, 1, 4)}), /occluder: .+; give three indices/);
assert.throws(() => tracker.addOccluder({...occluder, map: 1}), /occluder: /);
console.log('ok   errors and matrices');
