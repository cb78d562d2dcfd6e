// node fleet_page_test.mjs PLAYER PAGE CHROMIUM WORK_FOLDER DEVICES_PROGRAM AXE
// The fleet's page, as fleet-page serves it, in Chromium with fifty simulated devices and a real broker, from what fleet-setup
// writes. Prints how long a redraw of the page takes, the broker's share of a core, and after what time it shows that a device has
// hung.
// Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {request} from 'node:https';
import {freePort, opened, skipWithout, sleep} from '../web/needs.mjs';
import {Screens, withBrowser} from '../web/visitor.mjs';

const [player, page, program, work, devicesProgram, axe] = process.argv.slice(2);
const BROKER = '/usr/sbin/mosquitto';
skipWithout([BROKER, 'install mosquitto'], ['/usr/bin/mosquitto_pub', 'install mosquitto-clients'], [`${page}/mqtt.min.js`, 'run scripts/make_fleet_page.sh'], [program, 'install chromium']);

const COUNT = 50;
const RED = 20;  // The first devices are in the group red, the others in blue.
const names = Array.from({length: COUNT}, (_, i) => `tablet-${String(i + 1).padStart(2, '0')}`);
// The first process runs all devices but one, and its last device is silent. The second process runs the other device, which
// hangs.
const SILENT = names[COUNT - 2];
const HANGING = names[COUNT - 1];

rmSync(work, {recursive: true, force: true});
mkdirSync(work, {recursive: true});
const [port, socketPort, pagePort] = [await freePort(), await freePort(), await freePort()];
const fleet = `${work}/fleet`;
execFileSync(player, ['fleet-setup', fleet, '--host', '127.0.0.1', '--site', 'pompeii', '--port', port, '--page-port', socketPort,
  '--broker-folder', `${fleet}/broker`, '--add', ...names.map((name, i) => `${name}:${i < RED ? 'red' : 'blue'}`)]);
writeFileSync(`${work}/mosquitto.conf`, `${process.getuid() === 0 ? 'user root\n' : ''}persistence false\nlog_dest none\ninclude_dir ${fleet}/broker\n`);

const started = [];
function start(file, ...options) {
  const child = spawn(file, options, {stdio: ['ignore', 'pipe', 'inherit']});
  started.push(child);
  child.text = '';
  child.stdout.setEncoding('utf8').on('data', (text) => { child.text += text; });
  return child;
}
function check(good, text) {
  console.log(`${good ? 'ok  ' : 'MISS'} ${text}`);
  assert.ok(good, text);
}

// Seconds of a processor that a process has used.
function processorSeconds(pid) {
  const fields = readFileSync(`/proc/${pid}/stat`, 'utf8').split(') ')[1].split(' ');
  return (Number(fields[11]) + Number(fields[12])) / 100;
}

const cell = (name, column) => `[...document.querySelectorAll('#rows tr')].find((row) => row.cells[1].textContent === '${name}')?.cells[${column}].textContent`;
const shown = `[...document.querySelectorAll('#rows tr')].filter((row) => !row.hidden).map((row) => row.cells[1].textContent)`;
const choose = (browser, id, value) => browser.evaluate(`(() => { const e = document.getElementById('${id}'); e.value = '${value}';
  e.dispatchEvent(new Event('input')); e.dispatchEvent(new Event('change')); })()`);
const click = (browser, selector) => browser.evaluate(`document.querySelector('${selector}').click()`);

// Status and type of the server's answer.
const answer = (path, method = 'GET') => new Promise((resolve) => request(
  {host: '127.0.0.1', port: pagePort, path, method, rejectUnauthorized: false}, (reply) => {
    reply.resume();
    resolve([reply.statusCode, reply.headers['content-type']]);
  }).end());

async function logIn(browser, password) {
  await browser.until(`!document.getElementById('login').hidden`);
  await browser.evaluate(`document.getElementById('password').value = '${password}'`);
  await click(browser, '#password-form button');
}

// The visits of fleet_devices.cc on its days, of the given number of devices of the first process.
const number = (value) => new Intl.NumberFormat('en').format(value);
const visitsOf = (day, i) => Math.max(0, 20 * (day + 2) - i);
const total = (values) => values.reduce((a, b) => a + b, 0);
const visitsOn = (days, devices) => total(days.flatMap((day) => Array.from({length: devices}, (_, i) => visitsOf(day, i))));

// The device of the second process counts like the first of the others.
async function report(browser, screens) {
  const last = visitsOn([2], COUNT - 1) + visitsOf(2, 0);
  await browser.until(`document.getElementById('report-sum').textContent === '${number(last)} visits on ${COUNT} devices'`);
  check(true, 'the report has the visits of the last day');
  await choose(browser, 'from', '2026-11-25');
  const all = visitsOn([0, 1, 2], COUNT - 1) + visitsOf(0, 0) + visitsOf(1, 0) + visitsOf(2, 0);
  await browser.until(`document.getElementById('report-sum').textContent.startsWith('${number(all)} visits on')`);
  const others = (hidden) => browser.evaluate(`['devices', 'commands', 'floor'].forEach((id) => { document.getElementById(id).hidden = ${hidden}; })`);
  await others(true);
  await screens.take(browser, 'report');
  for (const [name, width, height] of [['wide', 1280, 1600], ['tall', 390, 2400]]) {
    writeFileSync(`${work}/report_${name}.png`, await browser.screenshot(width, height));
  }
  await others(false);
  await choose(browser, 'to', '2026-11-25');
  // Each visit of the day lost tracking in this square. Devices with fewer than ten visits do not tell.
  const told = total([...Array(COUNT - 1).keys()].map((i) => visitsOf(0, i)).filter((visits) => visits >= 10)) + visitsOf(0, 0);
  await browser.until(`document.getElementById('lost').getAttribute('aria-label').includes('x -1, z 0: ${told}')`);
  check(true, 'counts of fewer than ten visits are left out of the sums');
  const lines = (await browser.evaluate('csvOf(chosenDays())')).trim().split('\r\n').map((line) => line.replaceAll('"', '').split(','));
  assert.deepEqual(lines[0].slice(1), ['device', 'what', 'which', 'count']);
  assert.equal(total(lines.filter(([, , what]) => what === 'visits').map((line) => Number(line[4]))), visitsOn([0], COUNT - 1) + visitsOf(0, 0));
  const counts = lines.filter(([, , what]) => what.startsWith('visits_')).map((line) => Number(line[4]));
  check(counts.length > 100 && Math.min(...counts) >= 10, 'the file has the same, and no count of fewer than ten visits');
  await choose(browser, 'to', '2026-11-27');
  await choose(browser, 'from', '2026-11-27');
}

async function visit(browser, broker, devices, hanging) {
  const screens = new Screens(work, axe);
  const url = `https://127.0.0.1:${pagePort}/`;
  const password = readFileSync(`${fleet}/staff.password`, 'utf8').trim();
  assert.deepEqual(await answer('/'), [200, 'text/html; charset=utf-8']);
  assert.deepEqual(await answer('/settings.json', 'HEAD'), [200, 'application/json']);
  for (const path of ['/../rights', '/%2e%2e/rights', '/page/index.html', '/server.key', '//', '/LICENSE.md']) {
    assert.deepEqual(await answer(path), [404, 'text/plain'], path);
  }
  assert.deepEqual(await answer('/', 'POST'), [405, 'text/plain']);
  check(true, 'only the files of the page are served');
  await browser.open(url, '');
  await browser.until(`!document.getElementById('login').hidden`);
  await screens.take(browser, 'login');
  await logIn(browser, 'wrong');
  await browser.until(`document.getElementById('refusal').textContent === 'This is not the password.'`);
  check(true, 'a wrong password is refused');
  await logIn(browser, password);
  await browser.until(`${shown}.length === ${COUNT} && document.getElementById('count').textContent.includes('${COUNT} connected')`);
  assert.deepEqual(await browser.evaluate(shown), names);
  check(true, 'all devices are shown in the order of their names');
  await browser.until(`${cell(SILENT, 3)} === 'The show does not answer'`);
  check(true, 'a player that is silent is said not to answer');
  assert.equal(await browser.evaluate(cell(names[7], 4)), '8%');
  assert.equal(await browser.evaluate(cell(names[3], 12)), 'aaaaaaaaaaaa');
  await screens.take(browser, 'devices');
  await browser.screenshot(1280, 900).then((image) => writeFileSync(`${work}/desktop.png`, image));
  if (screens.axe !== undefined) {
    await screens.check(browser, 'devices, desktop');
  }

  await choose(browser, 'condition', 'attention');
  const attention = names.filter((_, i) => i < COUNT - 1 && (i % 10 === 5 || i % 10 === 7 || i === COUNT - 2));
  await browser.until(`JSON.stringify(${shown}) === '${JSON.stringify(attention)}'`);
  check(true, `${attention.length} devices are hot, empty or silent`);
  await choose(browser, 'condition', 'all');
  await choose(browser, 'group', 'red');
  await browser.until(`${shown}.length === ${RED}`);
  await choose(browser, 'search', '-1');
  await browser.until(`${shown}.length === 10`);
  await choose(browser, 'search', '');
  await browser.until(`${shown}.length === ${RED}`);
  check(true, 'group and name limit what is shown');

  await click(browser, '#all');
  await browser.until(`document.getElementById('selected').textContent === '${RED} selected'`);
  await click(browser, 'button[data-do=restart]');
  await browser.until(`document.getElementById('sent').textContent === 'Sent to ${RED} devices'`);
  await browser.until(`[...document.getElementById('choose-voices').options].some((option) => option.value === 'it')`);
  await choose(browser, 'choose-voices', 'it');
  await click(browser, 'button[data-do=hold]');
  await click(browser, 'button[data-do=update]');
  const obeyedSoFar = () => devices.text.split('\n').filter((line) => line.includes('{')).sort();
  for (let i = 0; i < 100 && obeyedSoFar().length < 4 * RED; ++i) {
    await sleep(0.2);
  }
  await sleep(1);
  const obeyed = obeyedSoFar();
  assert.deepEqual(obeyed, names.slice(0, RED).flatMap((name) => [
    `${name} {"do":"hold"}`, `${name} {"do":"language","value":"it"}`, `${name} {"do":"restart"}`, `${name} {"do":"update"}`]).sort());
  check(true, `commands reached the ${RED} devices that were selected, once, and no other`);
  await choose(browser, 'group', '');

  check(await browser.evaluate(`document.querySelectorAll('#plan circle').length`) === COUNT, 'the plan shows all devices');

  await report(browser, screens);

  // The page's own redraws, from their first text to the layout after them.
  await browser.evaluate(`void (() => { const [rows, plan] = [showRows, showPlan]; let begin; window.times = [];
    showRows = () => { begin = performance.now(); rows(); };
    showPlan = () => { plan(); document.body.offsetHeight; times.push(performance.now() - begin); }; })()`);
  const before = processorSeconds(broker.pid);
  await sleep(10);
  const times = await browser.evaluate(`times.sort((a, b) => a - b)`);
  console.log(`redraw of ${COUNT} devices: median ${times[times.length >> 1].toFixed(1)} ms, longest ${times.at(-1).toFixed(1)} ms of ${times.length}`);
  console.log(`broker: ${(10 * (processorSeconds(broker.pid) - before)).toFixed(1)} % of a core with ${COUNT} devices and a page`);

  // A stopped process is to the broker like a device whose network was unplugged.
  hanging.kill('SIGSTOP');
  const began = Date.now();
  for (const word of ['is not heard', 'gone']) {
    await browser.until(`${cell(HANGING, 3)} === '${word}'`);
    console.log(`a device without a network "${word}" after ${((Date.now() - began) / 1000).toFixed(1)} s`);
  }

  // A device may write what it likes as its own state.
  const folder = `${fleet}/devices/${HANGING}`;
  const publish = (what, text) => execFileSync('mosquitto_pub', ['-h', '127.0.0.1', '-p', port, '--cafile', `${folder}/authority.crt`,
    '-u', HANGING, '-P', readFileSync(`${folder}/password`, 'utf8').trim(), '-t', `lararium/pompeii/device/${HANGING}/${what}`, '-m', text]);
  publish('presence', '{"online": true}');
  for (const text of ['{', '[]', '{"answers": true, "player": {}}', '{"answers": true, "player": {"power": 7, "languages": "<b>"}}',
    `{"answers": true, "player": ${JSON.stringify({place: '<img src=x onerror=alert(1)>', position: [1e999, null, 'x']})}}`]) {
    publish('state', text);
    await browser.until(`['The show does not answer', 'its state is not understood'].includes(${cell(HANGING, 3)})`, 5);
  }
  await browser.until(`${cell(names[0], 3)} === 'Waiting for a visitor'`);
  check(await browser.evaluate(`document.querySelectorAll('#rows b, img').length`) === 0, 'malformed states disturb no other device');

  const day = '{"day": "2026-11-27", "visitors": 10, "completed": 0, "losses": 0, "restarts": 0, "played_seconds": 0, "seen_seconds": 0, "tracked_seconds": 0';
  for (const text of ['{', '[]', '{"schema": 2, "days": []}', '{"schema": 1, "days": [{}]}', `{"schema": 1, "days": [${day}, "lengths": [-1]}]}`,
    `{"schema": 1, "days": [${day}, "languages": {"<b>": 10}}]}`, `{"schema": 1, "days": [${day}, "lost": [{"place": "=1+1", "x": 0, "z": 0, "visits": 10}]}]}`,
    `{"schema": 1, "days": [], "more": "${'x'.repeat(60_000)}"`]) {
    publish('statistics', '{"schema": 1, "days": []}');
    await browser.until(`document.getElementById('not-understood').hidden`);
    publish('statistics', text);
    await browser.until(`document.getElementById('not-understood').textContent === 'The statistics of ${HANGING} are not understood and are left out'`, 5);
  }
  check(await browser.evaluate(`document.getElementById('report-sum').textContent`) === `${number(visitsOn([2], COUNT - 1))} visits on ${COUNT - 1} devices`,
    'malformed statistics are one warning and disturb no others');

  // A visitor's page is there while it plays.
  const ofPage = (what, text) => execFileSync('mosquitto_pub', ['-h', '127.0.0.1', '-p', port, '--cafile', `${fleet}/authority.crt`, '-u', 'visitors',
    '-P', readFileSync(`${fleet}/visitors.password`, 'utf8').trim(), '-i', 'abc', '-r', '-t', `lararium/pompeii/device/page/abc/${what}`, '-m', text]);
  ofPage('presence', '{"online": true}');
  await browser.until(`${shown}.includes('page/abc')`);
  ofPage('presence', '{"online": false}');
  await browser.until(`!${shown}.includes('page/abc')`);
  check(true, "a visitor's page is shown until it goes");

  publish('presence', '{"online": false}');
  await browser.until(`${cell(HANGING, 3)} === 'gone'`);
  await browser.evaluate(`[...document.querySelectorAll('#rows input')].find((box) => box.ariaLabel === '${HANGING}').click()`);
  await click(browser, '#forget');
  await browser.until(`${shown}.length === ${COUNT - 1}`);
  check(true, 'a device that is gone can be forgotten');

  await browser.open(url, `Object.defineProperty(navigator, 'languages', {get: () => ['it-IT', 'en']})`);
  await logIn(browser, password);
  await browser.until(`${cell(names[0], 3)} === 'In attesa di un visitatore'`);
  check(await browser.evaluate('document.documentElement.lang') === 'it', 'the page speaks Italian');
  await screens.take(browser, 'italian');

  broker.kill('SIGKILL');
  await browser.until(`document.getElementById('status').textContent.startsWith('Nessun collegamento')`);
  check(true, 'a lost broker is told');
  start(BROKER, '-c', `${work}/mosquitto.conf`);
  await browser.until(`document.getElementById('status').textContent === 'Collegato' && document.getElementById('count').textContent.includes('${COUNT - 1} collegati')`, 90);
  check(true, 'page and devices connect again by themselves');
}

try {
  const broker = start(BROKER, '-c', `${work}/mosquitto.conf`);
  await opened(socketPort);
  start(player, 'fleet-page', `${fleet}/broker`, '--address', pagePort);
  await opened(pagePort);
  const devices = start(devicesProgram, fleet, ...names.slice(0, -1));
  const hanging = start(devicesProgram, fleet, HANGING);
  await withBrowser(program, work, ['--ignore-certificate-errors'], (browser) => visit(browser, broker, devices, hanging));
} finally {
  started.forEach((child) => child.kill('SIGKILL'));
}
