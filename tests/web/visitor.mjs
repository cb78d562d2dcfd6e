// What tests of visits to the page share: a camera, sentences and buttons, screenshots, and the check of each screen with
// axe-core.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync, readFileSync, writeFileSync} from 'node:fs';
import {Chromium} from './chromium.mjs';

// Writes a video that stands for the camera. The software renderer is slow, so the camera is, too: four images a second.
// The camera looks at the place for 20 s and at something else for 10 s, again and again.
export function writeCamera(video, width, height, file) {
  execFileSync('ffmpeg', ['-v', 'error', '-y', '-i', video, '-f', 'lavfi', '-i', `testsrc2=size=${width}x${height}:rate=4:duration=10`,
    '-filter_complex', '[0]trim=end_frame=80,setpts=N/4/TB,fps=4[a];[a][1]concat,format=yuv420p', '-f', 'yuv4mpegpipe', file]);
}
export const cameraOptions = (file) => ['--use-fake-device-for-media-stream', `--use-file-for-fake-video-capture=${file}`];

export async function withBrowser(program, work, options, use) {
  const browser = new Chromium(program, work, options);
  try {
    await use(browser);
  } catch (error) {
    console.log(browser.console.join('\n'));
    throw error;
  } finally {
    await browser.close();
  }
}

export const says = (words) => `document.getElementById('text')?.innerText.includes(${JSON.stringify(words)}) && !document.getElementById('card').hidden`;
export const READY = `document.getElementById('go')?.onclick`;
export const PLAYS = `document.getElementById('card').hidden`;
export const press = (browser, id = 'go') => browser.evaluate(`document.getElementById('${id}').click()`, true);

export const FOCUSED = `document.activeElement.id || document.activeElement.dataset.key`;
const KEYS = {Tab: [9], Enter: [13, '\r'], Escape: [27], ArrowDown: [40], Home: [36], End: [35], ' ': [32, ' '], k: [75, 'k']};
export const type = async (browser, ...names) => {
  for (const name of names) {
    await browser.pressKey(name, ...KEYS[name]);
  }
};

// Presses Tab until an element has the focus, which must be seen.
export async function focus(browser, id) {
  for (let i = 0; i < 20 && await browser.evaluate(FOCUSED) !== id; ++i) {
    await type(browser, 'Tab');
  }
  assert.equal(await browser.evaluate(FOCUSED), id);
  assert.notEqual(await browser.evaluate('getComputedStyle(document.activeElement).outlineStyle'), 'none', `the focus on ${id} is seen`);
}

// Takes screenshots of a screen, and checks it with axe-core where that is given.
export class Screens {
  constructor(work, axe) {
    this.work = work;
    this.axe = existsSync(axe) ? readFileSync(axe, 'utf8') : undefined;
    this.shots = [];
  }

  async take(browser, name) {
    for (const [form, width, height] of [['portrait', 390, 844], ['landscape', 844, 390]]) {
      const file = `${name}_${form}.png`;
      writeFileSync(`${this.work}/${file}`, await browser.screenshot(width, height));
      this.shots.push(file);
      if (this.axe !== undefined) {
        await this.check(browser, `${name}, ${form}`);
      }
    }
  }

  async check(browser, screen) {
    await browser.evaluate(`void (window.axe ?? (() => {${this.axe}})())`);
    const found = JSON.parse(await browser.evaluate(`axe.run(document, {resultTypes: ['violations'], runOnly: ['wcag2a', 'wcag2aa',
      'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice']}).then(({violations, passes}) => JSON.stringify({passes: passes.length,
      violations: violations.map(({id, nodes}) => ({id, nodes: nodes.map(({html, failureSummary}) => html + ': ' + failureSummary)}))}))`));
    console.log(`${found.violations.length === 0 ? 'ok  ' : 'MISS'} axe-core, ${screen}: ${found.violations.length} violations, ` +
      `${found.passes} rules passed`);
    assert.deepEqual(found.violations, []);
  }
}
