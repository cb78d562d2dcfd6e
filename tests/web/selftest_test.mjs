// node selftest_test.mjs EDITOR PAGE CHROMIUM WORK_FOLDER PROJECT VIDEO AXE
// The self-test of a show in Chromium: its report has every figure, finds the place and its lens, and says so if people
// are not drawn or the image is. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {mkdirSync, readFileSync} from 'node:fs';
import {exportFolder, fileIn, serve, skipWithout} from './needs.mjs';
import {cameraOptions, press, Screens, withBrowser, writeCamera} from './visitor.mjs';

const [editor, page, program, work, project, video, axe] = process.argv.slice(2);
skipWithout([`${page}/module.wasm`, 'build the preset `web`'], [editor, 'build lararium-editor'],
  [project, 'run the test acceptance/maquette'], [video, 'set LARARIUM_DATA_DIR'], [program, 'install chromium'],
  ['/usr/bin/ffmpeg', 'install ffmpeg'], [axe, 'run scripts/fetch_axe.sh']);
// The focal length of the test's video over its width.
const TRUE_FOCAL = 0.875;

mkdirSync(work, {recursive: true});
const camera = `${work}/camera.y4m`;
writeCamera(video, 640, 480, camera);
const folder = `${work}/folder`;
exportFolder(editor, project, page, folder);
const server = await serve((path) => fileIn(folder, path));
const screens = new Screens(work, axe);

async function report(browser, prepare = '') {
  await browser.open(`${server.origin}/selftest.html`, prepare);
  await browser.until(`document.getElementById('go')?.onclick`);
  await press(browser);
  await browser.until(`!document.getElementById('copy').disabled`, 240);
  const lines = (await browser.evaluate(`document.getElementById('report').value`)).split('\n');
  console.log(lines.map((line) => `     ${line}`).join('\n'));
  return Object.fromEntries(lines.map((line) => line.split(/: (.*)/, 2)));
}

await withBrowser(program, work, cameraOptions(camera), async (browser) => {
  await browser.setCamera(server.origin, 'granted');
  const good = await report(browser);
  await screens.take(browser, 'selftest');
  assert.match(good['picture without people'], /^good, /);
  assert.match(good['picture with people'], /^good, /);
  assert.match(good.camera, /, 640x480, /);
  assert.match(good.images, /^[1-9]\d* in 10 s, as (I420|NV12|RGBA)$/);
  for (const name of ['one picture, staged and drawn', ...['reading', 'luminance', 'tracking', 'drawing'].map((stage) => `an image, ${stage}`)]) {
    assert.match(good[name], /^\d+\.\d ms, at most \d+\.\d ms for 95 %$/, name);
  }
  assert.match(good.place, /^found, confidence (0\.\d+|1\.000)$/);
  const [, focal] = /focal length ([\d.]+) of the width/.exec(good.lens);
  assert.ok(Math.abs(focal / TRUE_FOCAL - 1) < 0.02, `the focal length is ${focal}, and should be ${TRUE_FOCAL}`);
  assert.match(good['memory of the show'], /^\d+ MiB$/);
  console.log('ok   report of a device on which all is well');

  // A device that draws nothing.
  const blind = await report(browser, `for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced']) {
    WebGL2RenderingContext.prototype[name] = () => {};
  }`);
  assert.match(blind['picture without people'], /^BAD, /);
  assert.match(blind['picture with people'], /^BAD, /);
  console.log('ok   report of a device that draws nothing');
});
server.close();
