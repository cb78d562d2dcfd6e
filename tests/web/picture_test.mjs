// node picture_test.mjs REFERENCE_PROGRAM WEB_FOLDER CHROMIUM WORK_FOLDER SHOW SECONDS
// A page in Chromium without a screen draws a moment of a show with WebGL 2, by SwiftShader; the picture is compared with
// the native one in OpenGL ES 3.0. Prints the calls and bytes that a frame hands to WebGL. Status 77: something that the
// test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {Chromium} from './chromium.mjs';
import {serve, skipWithout} from './needs.mjs';
import {decibels} from './pictures.mjs';

const [reference, web, chromium, work, show, seconds] = process.argv.slice(2);
skipWithout(
  [`${web}/draw_moment.wasm`, 'build the preset `web`'], [show, 'run ./demo'], [chromium, 'install chromium']);
const LEAST_DB = 40;
const MOST_DRAWS = 200;
const MOST_BYTES = 4e6;

// Runs in the page: counts what each frame hands to WebGL, and runs the program on the show.
async function draw(seconds) {
  const frames = [{calls: 0, draws: 0, bytes: 0}];
  const bytesOf = {
    bufferData: (a) => a.length > 3 ? a[4] : 0,
    bufferSubData: (a) => a[4],
    texImage2D: (a) => a[8] ? a[3] * a[4] * texelBytes(a[6], a[7]) : 0,
    texSubImage2D: (a) => a[4] * a[5] * texelBytes(a[6], a[7]),
  };
  const gl = WebGL2RenderingContext;
  const texelBytes = (format, type) => ({[gl.RGBA]: 4, [gl.RGB]: 3, [gl.RG]: 2}[format] ?? 1) *
    ({[gl.FLOAT]: 4, [gl.HALF_FLOAT]: 2}[type] ?? 1);
  for (const name of Object.getOwnPropertyNames(gl.prototype)) {
    const {value} = Object.getOwnPropertyDescriptor(gl.prototype, name);
    if (typeof value !== 'function') {
      continue;
    }
    gl.prototype[name] = function (...args) {
      const frame = frames.at(-1);
      ++frame.calls;
      frame.draws += name.startsWith('draw') && name !== 'drawBuffers' ? 1 : 0;
      frame.bytes += bytesOf[name]?.(args) ?? (/^uniform.*v$/.test(name) ? 4 * args.at(-1) : 0);
      const result = value.apply(this, args);
      if (name === 'finish') {  // A frame ends here.
        frames.push({calls: 0, draws: 0, bytes: 0});
      }
      return result;
    };
  }
  const said = [];
  const print = (text) => said.push(text);
  try {
    const program = await createProgram({print, printErr: print});
    program.FS.writeFile('/show', new Uint8Array(await (await fetch('/show')).arrayBuffer()));
    const start = performance.now();
    const status = program.callMain(['/show', seconds, '/picture']);
    said.push(`status ${status} after ${Math.round(performance.now() - start)} ms`);
    const context = document.getElementById('lararium').getContext('webgl2');
    said.push(`error ${context.getError()}`);
    window.picture = Array.from(program.FS.readFile('/picture'));
  } catch (error) {
    said.push(`${error}`);
  }
  window.report = {frames, said};
}

const page = `${work}/picture.html`;
writeFileSync(page, `<!doctype html><meta charset=utf-8><title>picture</title><canvas id=lararium width=640 height=480></canvas>
<script src=/draw_moment.js></script><script>(${draw})(${JSON.stringify(seconds)})</script>`);
const server = await serve((path) => ({'/': page, '/show': show, '/draw_moment.js': `${web}/draw_moment.js`,
  '/draw_moment.wasm': `${web}/draw_moment.wasm`})[path]);
const browser = new Chromium(chromium, work, []);
let report, drawn;
try {
  await browser.open(server.origin, '');
  await browser.until('window.report !== undefined', 500);
  [report, drawn] = await browser.evaluate('[report, window.picture]');
} finally {
  await browser.close();
  server.close();
}
console.log(`     the page says: ${report.said.join('; ')}`);
assert.ok(drawn, 'the page has drawn nothing');
drawn = Buffer.from(drawn);

execFileSync(reference, [show, seconds, `${work}/picture.bgr`], {stdio: 'inherit', env: {...process.env, LIBGL_ALWAYS_SOFTWARE: '1'}});
const expected = readFileSync(`${work}/picture.bgr`);
writeFileSync(`${work}/picture_web.bgr`, drawn);
assert.equal(drawn.length, expected.length);
assert.equal(drawn.length, 3 * 640 * 480);
const worst = drawn.reduce((most, value, i) => Math.max(most, Math.abs(value - expected[i])), 0);
const likeness = decibels(expected, drawn);
console.log(`${likeness >= LEAST_DB ? 'ok  ' : 'MISS'} page against OpenGL ES 3.0: ${likeness.toFixed(1)} dB (bar ${LEAST_DB}), largest difference ${worst} of 255`);
const frame = report.frames[2];  // The first frame uploads what stays.
console.log(`${frame.draws <= MOST_DRAWS && frame.bytes <= MOST_BYTES ? 'ok  ' : 'MISS'} a frame: ${frame.calls} calls, ` +
  `${frame.draws} of them draw (bar ${MOST_DRAWS}), ${(frame.bytes / 1e6).toFixed(2)} MB (bar ${MOST_BYTES / 1e6})`);
assert.ok(likeness >= LEAST_DB && frame.draws > 0);
process.exit(0);
