// Shows all devices of a site, and sends commands to those that are selected. The page is a client of the broker, by
// WebSocket. Every text is put in as text, never as HTML.
'use strict';

let words = {};
const language = navigator.languages.map((tag) => tag.slice(0, 2)).find((tag) => tag === 'en' || tag === 'it') ?? 'en';
const kRedrawMs = 500;
const kMostDevices = 1000;
const kMostOnTheirWay = 10;
const kMostText = 100;
const kSilentMs = 6000;  // Devices publish at least every two seconds.
const kLowBattery = 0.15;
const kHot = 80;
const kPoorlyTracked = 0.5;
const kMargin = 0.5;  // metres around what a plan shows
const kDotShare = 0.012;  // radius of a device's dot, of the width of the plan
const kLineShare = 0.0015;

let site = '';
let broker = '';
let client = null;
let plans = {};
// What is known of each device, by its name: `state` and `online` as they were published, `seen`, when it last spoke
// (milliseconds of this machine's clock), `row`, its `cells` and its `dot` on the plan as they are drawn, and whether
// it is `selected`.
const devices = new Map();

// --- What the broker says

function remove(name) {
  devices.get(name)?.row?.remove();
  devices.get(name)?.dot?.remove();
  devices.delete(name);
  forgetStatistics(name);
}

// Names of visitors' pages begin with "page/".
function take(topic, payload, kept) {
  const parts = topic.split('/');
  const [kind, name, what] = [parts[2], parts.slice(3, -1).join('/'), parts.at(-1)];
  if (kind !== 'device' || (!devices.has(name) && devices.size >= kMostDevices)) {
    return;
  }
  if (payload.length === 0) {
    remove(name);
    return;
  }
  if (what === 'statistics') {
    takeStatistics(name, payload);
    return;
  }
  let value;
  try {
    value = JSON.parse(new TextDecoder().decode(payload));
  } catch {
    value = null;
  }
  const device = devices.get(name) ?? {name, state: null, online: false, seen: 0, selected: false, row: null, cells: []};
  devices.set(name, device);
  if (what === 'presence') {
    device.online = value?.online === true;
    if (!device.online && name.startsWith('page/')) {  // Visitors leave, and the broker forgets them.
      remove(name);
    }
  } else if (what === 'state') {
    device.state = value;
    device.seen = kept ? 1000 * Number(value?.time ?? 0) : Date.now();
  }
}

function connect(password) {
  client?.end(true);
  client = mqtt.connect(broker, {
    username: 'staff', password, clientId: `lararium-page-${Math.random().toString(16).slice(2, 10)}`, clean: true,
    reconnectPeriod: 2000, connectTimeout: 5000, keepalive: 60, timerVariant: 'native',
  });
  status('connecting_broker');
  client.on('connect', () => {
    status('connected', 'good');
    byId('login').hidden = true;
    ['devices', 'commands', 'floor', 'report'].forEach((id) => { byId(id).hidden = false; });
    client.subscribe(['+/state', '+/presence', '+/statistics', 'page/+/state', 'page/+/presence'].map((what) => `lararium/${site}/device/${what}`));
  });
  client.on('message', (topic, payload, packet) => take(topic, payload, packet.retain));
  client.on('close', () => {
    if (!client.disconnecting) {
      status('no_broker', 'bad');
    }
  });
  client.on('error', (error) => {
    // The broker's codes for a wrong name or password, and for no right to connect.
    if (error.code === 4 || error.code === 5) {
      client.end(true);
      byId('status').textContent = '';
      refuse(words.wrong_password);
    }
  });
}

function status(word, kind = '') {
  byId('status').textContent = words[word];
  byId('status').className = `status ${kind}`;
}

function refuse(text) {
  byId('login').hidden = false;
  byId('refusal').textContent = text;
  byId('refusal').hidden = text === '';
}

// --- What is shown of a device

// The condition as [word, kind].
function conditionOf({state, online, seen}) {
  if (!online) {
    return ['gone', 'bad'];
  }
  if (Date.now() - seen > kSilentMs) {
    return ['not_heard', 'bad'];
  }
  if (!state?.answers) {
    return ['no_answer', 'bad'];
  }
  const {visitor} = state.player;
  return visitor === null ? ['plays', 'good'] : visitor ? ['playing', 'good'] : ['idle', ''];
}

// Texts of a row's cells as [text, kind].
function cellsOf(device) {
  const {state} = device;
  const [word, kind] = conditionOf(device);
  const since = Math.max(0, (Date.now() - device.seen) / 1000);
  const seen = device.seen === 0 ? '–' : 1000 * since < kSilentMs ? words.now : words.ago.replace('{}', span(since));
  if (!state?.player) {
    return [[state?.group ?? ''], [words[word], kind], ...Array(9).fill(['–']), [seen]];
  }
  const {player} = state;
  const {battery, charging, celsius} = player.power;
  const {tracked_minute} = player.tracking;
  return [
    [state.group],
    [words[word], kind],
    [battery === null ? '–' : `${percent(battery)}${charging ? ' ⚡' : ''}`, battery !== null && !charging && battery < kLowBattery ? 'bad' : ''],
    [celsius === null ? '–' : `${number(celsius, 0)} °C`, celsius >= kHot ? 'bad' : ''],
    [percent(tracked_minute), player.visitor && tracked_minute < kPoorlyTracked ? 'bad' : ''],
    [player.length === null ? clock(player.seconds) : `${clock(player.seconds)} / ${clock(player.length)}`],
    [player.languages.length === 0 ? '–' : languageName(player.language || player.languages[0])],
    [player.sound.audible ? percent(player.sound.volume) : words.silent],
    [String(player.restarts)],
    [player.version],
    [player.show],
    [seen],
  ];
}

const needsAttention = (cells) => cells.some(([, kind]) => kind === 'bad');

// A state that is not as docs/file-formats.md has it is shown as one that is not understood.
function safeCells(device) {
  try {
    return cellsOf(device);
  } catch {
    return [[''], [device.online ? words.not_understood : words.gone, 'bad'], ...Array(10).fill(['–'])];
  }
}

function makeRow(device) {
  const row = document.createElement('tr');
  const box = document.createElement('input');
  box.type = 'checkbox';
  box.setAttribute('aria-label', device.name);
  box.addEventListener('change', () => {
    device.selected = box.checked;
    showSelection();
  });
  row.insertCell().append(box);
  const name = document.createElement('th');
  name.scope = 'row';
  name.textContent = device.name;
  row.append(name);
  return row;
}

function update(cell, value, kind = '') {
  const text = String(value).slice(0, kMostText);
  if (cell.textContent !== text) {
    cell.textContent = text;
  }
  if (cell.className !== kind) {
    cell.className = kind;
  }
}

function isShown(device, cells) {
  const condition = byId('condition').value;
  const group = byId('group').value;
  return device.name.toLowerCase().includes(byId('search').value.toLowerCase()) &&
    (group === '' || device.state?.group === group) &&
    (condition === 'all' || (condition === 'gone' ? !device.online : needsAttention(cells)));
}

const shownDevices = () => [...devices.values()].filter((device) => device.row !== null && !device.row.hidden);
const selectedDevices = () => shownDevices().filter((device) => device.selected);

function showRows() {
  const body = byId('rows');
  for (const device of devices.values()) {
    const cells = safeCells(device);
    device.cells = cells;
    if (device.row === null) {
      device.row = makeRow(device);
      const order = (row) => row.cells[1].textContent.localeCompare(device.name, 'en', {numeric: true});
      body.insertBefore(device.row, [...body.rows].find((row) => order(row) > 0) ?? null);
    }
    cells.forEach(([text, kind], i) => update(device.row.cells[i + 2] ?? device.row.insertCell(), text, kind));
    device.row.classList.toggle('gone', !device.online);
    device.row.hidden = !isShown(device, cells);
  }
  const all = [...devices.values()];
  const online = all.filter((device) => device.online).length;
  update(byId('count'), words.count.replace('{shown}', shownDevices().length).replace('{all}', all.length).replace('{online}', online));
}

// Options that are there already stay, and so does what is chosen.
function offer(select, codes, name) {
  const wanted = codes.join(' ');
  if (select.dataset.codes !== wanted) {
    select.dataset.codes = wanted;
    const chosen = select.value;
    select.replaceChildren(...codes.map((code) => new Option(name(code), code)));
    select.value = codes.includes(chosen) ? chosen : codes[0] ?? '';
  }
}

const distinct = (values) => [...new Set(values)].sort();

function showSelection() {
  const chosen = selectedDevices();
  update(byId('selected'), words.selected.replace('{}', chosen.length));
  byId('all').checked = chosen.length > 0 && chosen.length === shownDevices().length;
  const offered = (field) => distinct(chosen.flatMap((device) => device.state?.player?.[field] ?? []));
  const captions = offered('caption_languages');
  offer(byId('choose-voices'), ['', ...offered('languages')], (code) => code === '' ? '–' : languageName(code));
  offer(byId('choose-captions'), ['', ...captions, ...(captions.length > 0 ? ['off'] : [])],
    (code) => code === '' ? '–' : languageName(code));
  offer(byId('choose-marker'), ['', ...distinct(chosen.flatMap(({state}) => state?.drama?.markers ?? state?.player?.markers ?? []))],
    (marker) => marker === '' ? '–' : marker);
  const holdable = chosen.some(({state}) => state?.drama || typeof state?.player?.held === 'boolean');
  for (const control of document.querySelectorAll('[data-do]')) {
    const ofDrama = ['hold', 'resume', 'go_to'].includes(control.dataset.do);
    control.disabled = chosen.length === 0 || (ofDrama && !holdable);
  }
  byId('forget').disabled = chosen.every(({online}) => online);
}

// --- The plan

function svg(name, attributes, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  Object.entries(attributes).forEach(([key, value]) => element.setAttribute(key, value));
  element.append(...children);
  return element;
}

const least = (values) => Math.floor(values.reduce((a, b) => Math.min(a, b)) - kMargin);
const most = (values) => Math.ceil(values.reduce((a, b) => Math.max(a, b)) + kMargin);

// Draws the ground under the devices: a line for each metre, and the surfaces of the place.
function floorOf(left, right, far, near, {cell = 0.1, points = []}) {
  let lines = '';
  for (let x = left; x <= right; ++x) {
    lines += `M${x} ${far}V${near}`;
  }
  for (let z = far; z <= near; ++z) {
    lines += `M${left} ${z}H${right}`;
  }
  const surface = points.map(([x, z]) => `M${x} ${z}h${cell}v${cell}h${-cell}z`).join('');
  return [svg('path', {class: 'grid', d: lines, 'stroke-width': kLineShare * (right - left)}), svg('path', {class: 'surface', d: surface})];
}
const viewOf = (left, right, far, near) => `${left} ${far} ${right - left} ${near - far}`;

// Seen from above: x to the right, and what lies ahead of the stage (-z) upwards.
function showPlan() {
  const located = [...devices.values()].filter(({state, online}) => online && Array.isArray(state?.player?.position));
  offer(byId('place'), distinct([...Object.keys(plans), ...located.map(({state}) => String(state.player.place))]), (place) => place);
  const place = byId('place').value;
  const here = located.filter(({state}) => state.player.place === place).map((device) => {
    const [x, , z] = device.state.player.position.map(Number);
    return {device, x, z};
  }).filter(({x, z}) => Number.isFinite(x) && Number.isFinite(z));
  const points = plans[place]?.points ?? [];
  const xs = [...points.map(([x]) => x), ...here.map(({x}) => x), -1, 1];
  const zs = [...points.map(([, z]) => z), ...here.map(({z}) => z), -1, 1];
  const bounds = [least(xs), most(xs), least(zs), most(zs)];
  const key = [place, ...bounds].join(' ');
  if (byId('ground').dataset.key !== key) {
    byId('ground').dataset.key = key;
    byId('plan').setAttribute('viewBox', viewOf(...bounds));
    byId('ground').replaceChildren(...floorOf(...bounds, plans[place] ?? {}));
  }
  const dot = kDotShare * (bounds[1] - bounds[0]);
  for (const {device, x, z} of here) {
    device.dot ??= svg('g', {}, svg('circle', {r: 1}), svg('text', {x: 1.5, y: 1, 'font-size': 3}, device.name));
    device.dot.setAttribute('transform', `translate(${x} ${z}) scale(${dot})`);
    device.dot.setAttribute('class', needsAttention(device.cells) ? 'bad' : '');
  }
  const dots = here.map(({device}) => device.dot);
  const drawn = byId('dots').children;
  if (dots.length !== drawn.length || dots.some((each, i) => each !== drawn[i])) {
    byId('dots').replaceChildren(...dots);
    byId('plan').setAttribute('aria-label', `${words.plan}: ${here.map(({device}) => device.name).join(', ') || words.no_devices}`);
  }
}

function redraw() {
  if (!document.hidden && !byId('devices').hidden) {
    const names = distinct([...devices.values()].map(({state}) => state?.group).filter((group) => typeof group === 'string' && group !== ''));
    offer(byId('group'), ['', ...names], (group) => group === '' ? words.all : group);
    showRows();
    showSelection();
    showPlan();
    showReport();
  }
}

// --- Commands

// Commands that wait, as [topic, text, callback], and how many are on their way. Mosquitto 2.0.11 never answers some messages of
// quality of service 2 if more than its max_inflight_messages (20) are on their way.
const waiting = [];
let onTheirWay = 0;
function sendWaiting() {
  while (waiting.length > 0 && onTheirWay < kMostOnTheirWay) {
    const [topic, text, done] = waiting.shift();
    ++onTheirWay;
    client.publish(topic, text, {qos: 2}, (error) => {
      --onTheirWay;
      done(error);
      sendWaiting();
    });
  }
}

function tell(command) {
  const chosen = selectedDevices();
  let answered = 0;
  let failed = 0;
  update(byId('sent'), words.sending);
  for (const {name} of chosen) {
    waiting.push([`lararium/${site}/device/${name}/do`, JSON.stringify(command), (error) => {
      failed += error ? 1 : 0;
      if (++answered === chosen.length) {
        update(byId('sent'), failed === 0 ? words.sent.replace('{}', answered) : words.not_sent, failed === 0 ? '' : 'bad');
      }
    }]);
  }
  sendWaiting();
}

// Deletes what the broker keeps of devices that are gone.
function forget() {
  for (const {name, online} of selectedDevices()) {
    for (const what of online ? [] : ['state', 'presence', 'statistics']) {
      client.publish(`lararium/${site}/device/${name}/${what}`, '', {qos: 1, retain: true});
    }
  }
}

function listen() {
  byId('password-form').addEventListener('submit', (event) => {
    event.preventDefault();
    refuse('');
    connect(byId('password').value);
    byId('password').value = '';
  });
  for (const id of ['search', 'group', 'condition', 'place']) {
    byId(id).addEventListener('input', redraw);
  }
  byId('filters').addEventListener('submit', (event) => event.preventDefault());
  byId('all').addEventListener('change', () => {
    for (const device of shownDevices()) {
      device.selected = byId('all').checked;
      device.row.querySelector('input').checked = device.selected;
    }
    showSelection();
  });
  byId('forget').addEventListener('click', forget);
  listenToReport();
  for (const button of document.querySelectorAll('button[data-do]')) {
    button.addEventListener('click', () => {
      const {sure} = button.dataset;
      if (!sure || confirm(words[sure].replace('{}', selectedDevices().length))) {
        tell({do: button.dataset.do});
      }
    });
  }
  for (const select of document.querySelectorAll('select[data-do]')) {
    select.addEventListener('change', () => {
      if (select.value !== '') {
        tell({do: select.dataset.do, value: select.value});
      }
      select.value = '';
    });
  }
}

async function load(file) {
  const reply = await fetch(file, {cache: 'no-store'});
  if (!reply.ok) {
    throw new Error(file);
  }
  return reply.json();
}

async function begin() {
  document.documentElement.lang = language;
  for (const file of ['words.json', 'fleet_words.json']) {
    Object.entries(await load(file)).forEach(([key, texts]) => { words[key] = texts[language]; });
  }
  for (const element of document.querySelectorAll('[data-word]')) {
    element.textContent = words[element.dataset.word];
  }
  byId('table').setAttribute('aria-label', words.devices);
  byId('all').setAttribute('aria-label', words.select_all);
  byId('report-table').setAttribute('aria-label', words.report);
  const settings = await load('settings.json');
  site = settings.site;
  broker = `wss://${settings.host}:${settings.page_port}/`;
  byId('title').textContent = `${words.fleet} ${site}`;
  document.title = byId('title').textContent;
  plans = await load('plans.json').catch(() => ({}));
  listen();
  refuse('');
  setInterval(redraw, kRedrawMs);
}

begin().catch(() => { byId('status').textContent = words.no_settings ?? 'settings.json?'; });
