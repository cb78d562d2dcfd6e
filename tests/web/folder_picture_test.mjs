// node folder_picture_test.mjs DRAW_MOMENT EDITOR PAGE WORK_FOLDER PROJECT SHOW SECONDS...
// What a folder for browsers leaves out of a show must not be seen: draws moments of the whole bundle and of the folder's
// content, in OpenGL ES 3.0, and compares the pictures. Prints the bytes that a page loads in its stages. Status 77:
// something that the test needs is absent.
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
// The picture is seen from this keyframe, which the folder's map has, too.
const KEYFRAME = 0;
const GREY = 110;  // The background has this brightness.
const LEAST_DRAWN = 0.05;  // Share of the picture that people and things cover.
const MEGA = 1e6;

mkdirSync(work, {recursive: true});
const folder = `${work}/folder`;
const report = exportFolder(editor, project, page, folder);
const {members, page: files, cast, spoken, captions} = JSON.parse(readFileSync(`${folder}/show/manifest.json`, 'utf8'));
const bytesOf = (list) => list.reduce((sum, {packed, size}) => sum + (packed ?? size), 0) / MEGA;
// The files that the page asks for; pieces that are equal are one file.
const known = new Set();
const named = (pattern) => members.filter(({name, sha256}) => pattern.test(name) && !known.has(sha256) && known.add(sha256));
const program_bytes = bytesOf(files.filter(({name}) => !/NOTICES|LICENSE|README|package|example|\.d\.ts|selftest|service_worker/.test(name)));
const languages = `(${spoken[0]?.name}|${captions[0]})`;
const bodies = cast.map(({human}) => bytesOf(members.filter(({name}) => name === human)));
const tracking = program_bytes + bytesOf(named(/^places.*(larscene|larmesh)$|captions\.json$|^captions/));
const drama = tracking + bytesOf(named(new RegExp(`^(places|sounds|drama|paradata)|motion|extent|^speech/${languages}/.*json$`)));
const voices = bytesOf(named(new RegExp(`^speech/${languages}/`)));
console.log(`     page ${program_bytes.toFixed(2)} MB, ${Object.entries(report.members).map(
  ([kind, bytes]) => `${kind} ${(bytes / MEGA).toFixed(2)}`).join(', ')}`);
console.log(`     until tracking starts ${tracking.toFixed(2)} MB, until the drama begins ${drama.toFixed(2)}, until the first person stands ` +
  `there at most ${(drama + Math.max(...bodies)).toFixed(2)} (bodies: ${bodies.map((bytes) => bytes.toFixed(2)).join(', ')}), all in one ` +
  `language ${(drama + voices + bytesOf(named(/^(cast|props)/))).toFixed(2)}`);

const lean = `${work}/folder.larshow`;
writeLarshow(folder, lean);
let worst = Infinity;
for (const seconds of moments) {
  const [full, reduced] = [show, lean].map((file, i) => {
    execFileSync(program, [file, seconds, `${work}/${i}.bgr`, KEYFRAME], {stdio: 'inherit', env: {...process.env, LIBGL_ALWAYS_SOFTWARE: '1'}});
    return readFileSync(`${work}/${i}.bgr`);
  });
  const drawn = full.reduce((sum, value) => sum + (Math.abs(value - GREY) > 4), 0) / full.length;
  assert.ok(drawn > LEAST_DRAWN, `people and things cover ${drawn} of the picture`);
  const likeness = decibels(full, reduced);
  worst = Math.min(worst, likeness);
  console.log(`${likeness >= LEAST_DB ? 'ok  ' : 'MISS'} at ${seconds} s: folder against the whole bundle ${likeness.toFixed(1)} dB (bar ${LEAST_DB})`);
}
assert.ok(worst >= LEAST_DB && worst < Infinity);
