// node fleet_test.mjs PLAYER EDITOR PAGE CHROMIUM WORK_FOLDER PROJECT VIDEO
// A visitor's page in Chromium and a player without a screen in one group, over a real broker, from what fleet-setup and the
// editor write. A video stands for the camera of both. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {exportFolder, fileIn, freePort, opened, serve, skipWithout, sleep} from './needs.mjs';
import {cameraOptions, PLAYS, press, READY, withBrowser, writeCamera} from './visitor.mjs';

const [player, editor, page, program, work, project, video] = process.argv.slice(2);
const BROKER = '/usr/sbin/mosquitto';
skipWithout(
  [`${page}/module.wasm`, 'build the preset `web`'], [`${page}/mqtt.min.js`, 'run scripts/fetch_mqtt.sh and build the preset `web`'],
  [player, 'build lararium-player'], [editor, 'build lararium-editor'], [`${project}/places/maquette/scene.larscene`, 'run the test acceptance/maquette'],
  [video, 'set LARARIUM_DATA_DIR'], [program, 'install chromium'], ['/usr/bin/ffmpeg', 'install ffmpeg'], [BROKER, 'install mosquitto'],
  ['/usr/bin/mosquitto_sub', 'install mosquitto-clients']);
const MOST_MOVED = 0.05;  // Seconds while the drama is held; the last differences disappear slowly.
const MOST_APART = 1;  // Seconds. The software renderer draws a few pictures a second, and states are told once a second.

rmSync(work, {recursive: true, force: true});
mkdirSync(work, {recursive: true});
const camera = `${work}/camera.y4m`;
writeCamera(video, 640, 480, camera);
const film = `${work}/camera.mp4`;  // A player reads no raw video.
execFileSync('ffmpeg', ['-v', 'error', '-y', '-i', camera, film]);
const [port, socketPort] = [await freePort(), await freePort()];
const fleet = `${work}/fleet`;
execFileSync(player, ['fleet-setup', fleet, '--host', '127.0.0.1', '--site', 'pompeii', '--port', port, '--page-port', socketPort,
  '--broker-folder', `${fleet}/broker`, '--add', 'tablet-01:red']);
writeFileSync(`${work}/mosquitto.conf`, `${process.getuid() === 0 ? 'user root\n' : ''}persistence false\nlog_dest none\ninclude_dir ${fleet}/broker\n`);
const bundle = `${work}/show.larshow`;
execFileSync(editor, ['export', project, '--out', bundle], {stdio: 'ignore'});
const folder = `${work}/folder`;
exportFolder(editor, project, page, folder, '--fleet', `wss://127.0.0.1:${socketPort}/pompeii`, '--fleet-password-file', `${fleet}/visitors.password`,
  '--group', 'red');
const server = await serve((path) => fileIn(folder, path));

const started = [];
function start(file, ...options) {
  const child = spawn(file, options, {stdio: ['ignore', 'pipe', 'inherit']});
  started.push(child);
  return child;
}

function check(good, text) {
  console.log(`${good ? 'ok  ' : 'MISS'} ${text}`);
  assert.ok(good, text);
}

const secret = (file) => readFileSync(`${fleet}/${file}`, 'utf8').trim();
const as = (user, file) => ['-h', '127.0.0.1', '-p', port, '--cafile', `${fleet}/authority.crt`, '-u', user, '-P', secret(file)];
const publish = (user, file, topic, text, ...more) => execFileSync('mosquitto_pub', [...as(user, file), '-q', '1', '-t', `lararium/pompeii/${topic}`, '-m', text, ...more]);

// The texts that devices have published, by topic, and when each came.
const heard = new Map();
function listen() {
  let rest = '';
  start('mosquitto_sub', ...as('staff', 'staff.password'), '-v', '-t', 'lararium/pompeii/device/#').stdout.setEncoding('utf8').on('data', (text) => {
    const lines = (rest + text).split('\n');
    rest = lines.pop();
    for (const line of lines) {
      const space = line.indexOf(' ');
      heard.set(line.slice('lararium/pompeii/device/'.length, space), {text: line.slice(space + 1), at: Date.now()});
    }
  });
}
const nameOfPage = () => [...heard.keys()].map((topic) => /^(page\/[0-9a-f]+)\/state$/.exec(topic)?.[1]).find((name) => name !== undefined);
const stateOf = (name) => JSON.parse(heard.get(`${name}/state`)?.text ?? 'null');
async function until(what, test, seconds = 100) {
  for (const end = Date.now() + 1000 * seconds; !test();) {
    if (Date.now() > end) {
      throw new Error(`not within ${seconds} s: ${what}; heard ${JSON.stringify([...heard])}`);
    }
    await sleep(0.1);
  }
  console.log(`ok   ${what}`);
}

// Seconds between the dramas, each at the time of its last state.
function apart(name) {
  const at = (device) => stateOf(device).player.seconds - heard.get(`${device}/state`).at / 1000;
  return Math.abs(at(name) - at('tablet-01'));
}

async function visit(browser, broker) {
  await browser.open(`${server.origin}/`, '');
  await browser.until(READY);
  await browser.setCamera(server.origin, 'granted');
  await press(browser);
  await browser.until(`document.getElementById('lararium').dataset.shows === 'show'`, 200);
  await until('the page publishes its state', () => nameOfPage() !== undefined);
  const name = nameOfPage();
  await until('the page follows the device', () => stateOf(name).drama.leader === 'tablet-01' && stateOf(name).drama.in_step);
  await until('both know of each other', () => stateOf('tablet-01').drama.members === 2 && stateOf('tablet-01').drama.leads);
  await until('they are at one time of the drama', () => apart(name) < MOST_APART);
  const fields = (device) => Object.keys(stateOf(device).player).sort().join();
  check(fields(name) === fields('tablet-01'), 'the state of the page has the fields of a player');
  check(stateOf(name).player.version === stateOf('tablet-01').player.version && stateOf(name).name === name, `the page is ${name}`);

  publish('staff', 'staff.password', `device/${name}/do`, '{"do": "volume", "value": 0.3}');
  await until('a command reaches the page', () => stateOf(name).player.sound.volume === 0.3);
  publish('staff', 'staff.password', 'group/red/do', '{"do": "hold"}');
  await until('the drama is held on both', () => stateOf(name).drama.held && stateOf('tablet-01').drama.held);
  const secondsOf = (device) => stateOf(device).player.seconds;
  const both = ['tablet-01', name];
  let stood = [];
  let since = 0;
  await until('it stands still on both', () => {
    const now = both.map(secondsOf);
    if (stood.length === 0 || now.some((seconds, i) => Math.abs(seconds - stood[i]) > MOST_MOVED)) {
      stood = now;
      since = Date.now();
    }
    return Date.now() - since > 5000;
  });
  // The drama never steps back: a device that has drawn a picture beyond the moment stays there.
  const frame = 1 / Math.min(...both.map((device) => stateOf(device).player.picture.frames_per_second));
  const held = Math.max(...stood);
  check(held - Math.min(...stood) < MOST_MOVED + frame, `they stand at ${stood.map((seconds) => seconds.toFixed(2)).join(' and ')} s`);
  publish('staff', 'staff.password', 'group/red/do', '{"do": "restart"}');
  await until('it begins again on both', () => secondsOf(name) < held && secondsOf('tablet-01') < held && apart(name) < MOST_APART);

  for (const topic of ['device/tablet-01/state', 'device/tablet-01/do', 'group/red/do', 'group/red/all/tablet-01', 'device/page/other/state']) {
    publish('visitors', 'visitors.password', topic, '{"do": "end"}', '-i', 'stranger');
  }
  publish('visitors', 'visitors.password', 'device/page/stranger/state', '{}', '-i', 'stranger');
  await until('the account of visitors writes under the name of its client', () => heard.has('page/stranger/state'));
  check(!heard.has('page/other/state') && stateOf('tablet-01').player !== undefined, 'and under no other');

  broker.kill('SIGKILL');
  await sleep(3);
  check(await browser.evaluate(PLAYS), 'without the broker the page plays on');
  heard.clear();
  start(BROKER, '-c', `${work}/mosquitto.conf`);
  await opened(port);
  listen();
  await until('all are together again', () => stateOf(name)?.drama.leader === 'tablet-01' && stateOf('tablet-01')?.drama.members === 2 && apart(name) < MOST_APART);
  await browser.evaluate('location.href = "about:blank"');
  await until('a page that goes says so', () => heard.get(`${name}/presence`)?.text === '{"online": false}');
}

try {
  const broker = start(BROKER, '-c', `${work}/mosquitto.conf`);
  await opened(port);
  await opened(socketPort);
  listen();
  start(player, bundle, '--headless', '--video', film, '--loop', '--pace', 'realtime', '--device', `${fleet}/devices/tablet-01/device.json`);
  await until('the device publishes its state', () => stateOf('tablet-01')?.drama.leads);
  await withBrowser(program, work, ['--ignore-certificate-errors', ...cameraOptions(camera)], (browser) => visit(browser, broker));
} finally {
  started.forEach((child) => child.kill('SIGKILL'));
  server.close();
}
