// node foreground_test.mjs PLAYER EDITOR PAGE CHROMIUM WORK_FOLDER PROJECT SHOW VIDEO
// The page hides people behind what stands before the place, where the native player finds it, too: in a video, a hand comes before
// the camera. Writes both pictures. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {exportFolder, fileIn, serve, skipWithout} from './needs.mjs';
import {READY, withBrowser} from './visitor.mjs';

const [player, editor, page, program, work, project, show, video] = process.argv.slice(2);
skipWithout([`${page}/module.wasm`, 'build the preset `web`'], [editor, 'build lararium-editor'], [player, 'build lararium-player'],
  [show, 'run the test acceptance/maquette'], [video, 'set LARARIUM_DATA_DIR'], [program, 'install chromium'], ['/usr/bin/ffmpeg', 'install ffmpeg']);
const IMAGES = 62;  // The hand covers people in the last of them.
const LEAST_HIDDEN = 500;  // Pixels of people.
const LEAST_SHARED = 0.9;  // Of these pixels, the native player finds foreground in this share.

mkdirSync(work, {recursive: true});
const folder = `${work}/folder`;
exportFolder(editor, project, page, folder);
execFileSync('ffmpeg', ['-v', 'error', '-y', '-i', video, '-frames:v', IMAGES, '-start_number', '0', `${work}/image%d.png`]);
const masks = `${work}/masks`;
rmSync(masks, {recursive: true, force: true});
mkdirSync(masks);
execFileSync(player, [show, '--video', video, '--headless', '--pace', 'fast', '--foreground-out', masks], {stdio: 'ignore'});
const mask = `${masks}/${String(IMAGES - 1).padStart(6, '0')}.png`;

const server = await serve((path) => path === '/mask.png' ? mask : path.startsWith('/image') ? `${work}${path}` : fileIn(folder, path));

// Runs in the page: plays the images, draws the last one with the points that were seen and without them, as if no foreground could
// be known, and returns how many pixels differ, how many of these are in the mask, and both pictures.
async function play(images) {
  const [{compilePrograms, Folder}, {Place}, {Show, SHOW}] = await Promise.all(['folder', 'place', 'show'].map((name) => import(`/${name}.js`)));
  const folder = await Folder.open();
  const [program, trackerProgram] = await compilePrograms();
  const show = await folder.openShow(Show, program);
  const languages = {spoken: '', captions: '', read: ''};
  await folder.supply(show, SHOW, languages);
  const place = new Place(show.maps(), trackerProgram);
  show.load(SHOW, languages);
  await place.ready;
  place.setOccluders(show.occluders());
  const pixelsOf = async (file) => {
    const image = await createImageBitmap(await (await fetch(file)).blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d', {willReadFrequently: true});
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, image.width, image.height);
  };
  const canvas = document.getElementById('lararium');
  const picture = () => {
    const context = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', {willReadFrequently: true});
    context.drawImage(canvas, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  // Draws an image some times, and returns the picture with the median of the milliseconds of the page's thread.
  const drawn = (draw) => {
    const times = Array.from({length: 9}, () => {
      const start = performance.now();
      draw();
      return performance.now() - start;
    });
    return {pixels: picture(), url: canvas.toDataURL(), ms: times.sort((a, b) => a - b)[4]};
  };
  let hidden, whole;
  for (let i = 0; i < images; ++i) {
    const {width, height, data} = await pixelsOf(`/image${i}.png`);
    Object.assign(canvas, {width, height});
    const luminance = show.setImage({format: 'RGBA', width, height, data});
    const {tracked, seen} = await new Promise((resolve, reject) => {
      Object.assign(place, {ontracked: resolve, onerror: reject});
      place.track(i, luminance, i / 30);
    });
    show.draw(tracked, seen, i / 30, 0, 1);
    if (i + 1 === images) {
      hidden = drawn(() => show.draw(tracked, seen, i / 30, 0, 1));
      whole = drawn(() => show.draw(tracked, new Float64Array(), i / 30, 0, 1));
    }
  }
  const mask = (await pixelsOf('/mask.png')).data;
  let changed = 0;
  let shared = 0;
  for (let at = 0; at < whole.pixels.length; at += 4) {
    if ([0, 1, 2].reduce((sum, i) => sum + Math.abs(whole.pixels[at + i] - hidden.pixels[at + i]), 0) > 48) {
      ++changed;
      shared += mask[at] > 0;
    }
  }
  return JSON.stringify({changed, shared, ms: hidden.ms - whole.ms, urls: {hidden: hidden.url, whole: whole.url}});
}

try {
  await withBrowser(program, work, [], async (browser) => {
    await browser.open(`${server.origin}/selftest.html`, '');
    await browser.until(READY);
    const {changed, shared, ms, urls} = JSON.parse(await browser.evaluate(`(${play})(${IMAGES})`));
    for (const [name, url] of Object.entries(urls)) {
      writeFileSync(`${work}/${name}.png`, Buffer.from(url.split(',')[1], 'base64'));
    }
    console.log(`${changed} pixels of people are hidden, ${(100 * shared / changed).toFixed(1)} % of them where the native player finds ` +
      `foreground; the mask costs ${ms.toFixed(1)} ms`);
    assert.ok(changed >= LEAST_HIDDEN);
    assert.ok(shared >= LEAST_SHARED * changed);
  });
} finally {
  server.close();
}
