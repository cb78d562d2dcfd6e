// node folder_picture_test.mjs DRAW_MOMENT EDITOR PAGE WORK_FOLDER PROJECT SHOW SECONDS...
// What a folder for browsers leaves out of a show must not be seen: draws moments of the whole bundle and of the folder's
// content, in OpenGL ES 3.0, and compares the pictures. Prints the bytes that a page loads. Status 77: something that the
// test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync} from 'node:fs';
import {writeLarshow} from './larshow.mjs';
import {exportFolder, skipWithout} from './needs.mjs';
import {decibels} from './pictures.mjs';

const [program, editor, page, work, project, show, ...moments] = process.argv.slice(2);
skipWithout([`${page}/module.wasm`, 'build the preset `web`'], [editor, 'build lararium-editor'], [project, 'run ./demo'],
  [show, 'run ./demo']);
const LEAST_DB = 40;
const MEGA = 1e6;

mkdirSync(work, {recursive: true});
const folder = `${work}/folder`;
const report = exportFolder(editor, project, page, folder);
const {members, page: files, spoken, captions} = JSON.parse(readFileSync(`${folder}/show/manifest.json`, 'utf8'));
const bytesOf = (list) => list.reduce((sum, {packed, size}) => sum + (packed ?? size), 0) / MEGA;
const named = (pattern) => members.filter(({name}) => pattern.test(name));
const program_bytes = bytesOf(files.filter(({name}) => !/NOTICES|LICENSE|README|package|example|\.d\.ts/.test(name)));
const first = program_bytes + bytesOf(named(/^places/));
const voices = new RegExp(`^speech/(${spoken[0]?.name}|${captions[0]})/`);
const whole = program_bytes + bytesOf(members.filter(({name}) => !name.startsWith('speech/') || voices.test(name)));
console.log(`     page ${program_bytes.toFixed(2)} MB, ${Object.entries(report.members).map(
  ([kind, bytes]) => `${kind} ${(bytes / MEGA).toFixed(2)}`).join(', ')}`);
console.log(`     until tracking starts ${first.toFixed(2)} MB, in one language ${whole.toFixed(2)} MB`);

const lean = `${work}/folder.larshow`;
writeLarshow(folder, lean);
let worst = Infinity;
for (const seconds of moments) {
  const [full, reduced] = [show, lean].map((file, i) => {
    execFileSync(program, [file, seconds, `${work}/${i}.bgr`], {stdio: 'inherit', env: {...process.env, LIBGL_ALWAYS_SOFTWARE: '1'}});
    return readFileSync(`${work}/${i}.bgr`);
  });
  const likeness = decibels(full, reduced);
  worst = Math.min(worst, likeness);
  console.log(`${likeness >= LEAST_DB ? 'ok  ' : 'MISS'} at ${seconds} s: folder against the whole bundle ${likeness.toFixed(1)} dB (bar ${LEAST_DB})`);
}
assert.ok(worst >= LEAST_DB && worst < Infinity);
