// Asks for the state once a second and shows it. Every text is put in as text, never as HTML.
'use strict';

const words = JSON.parse(document.getElementById('words').textContent);
const language = document.documentElement.lang;
const kStateMs = 1000;
const kPictureMs = 2000;
const kDaysMs = 30000;
const kDaysShown = 7;

let pin = '';

function put(id, text, kind = '') {
  const element = byId(id);
  element.textContent = text;
  element.classList.remove('good', 'bad');
  if (kind) {
    element.classList.add(kind);
  }
}

function showTracking(tracking) {
  if (tracking.state === 'tracking') {
    put('tracking', words.following, 'good');
    return;
  }
  const state = tracking.state === 'lost' ? words.lost : words.searching;
  const reason = words[tracking.reason] ? ` – ${words[tracking.reason]}` : '';
  put('tracking', `${state}, ${clock(tracking.lost_seconds)}${reason}`, 'bad');
}

function showMachine(player) {
  const {battery, charging, celsius} = player.power;
  put('battery', battery === null ? words.no_battery
    : `${percent(battery)}, ${charging ? words.charging : words.discharging}`,
    battery !== null && !charging && battery < 0.15 ? 'bad' : '');
  put('temperature', celsius === null ? words.unknown : `${number(celsius, 0)} °C`,
    celsius !== null && celsius >= 80 ? 'bad' : '');
  put('rate', number(player.picture.frames_per_second, 1));
  put('quality', player.picture.quality === 0 ? `0 (${words.finest})` : String(player.picture.quality));
  put('memory', `${number(player.memory_mib, 0)} MiB`);
  put('running', span(player.up_seconds));
  put('restarts', String(player.restarts));
  put('version', player.version);
}

function showSound(player) {
  const {volume, audible} = player.sound;
  put('volume', audible ? percent(volume) : `${percent(volume)}, ${words.silent}`);
  const spoken = player.languages;
  const readable = player.caption_languages;
  put('voices', spoken.length === 0 ? '–' : languageName(player.language || spoken[0]));
  put('captions', readable.length === 0 ? '–' : languageName(player.captions || readable[0]));
  fill(byId('choose-voices'), spoken, player.language);
  fill(byId('choose-captions'), readable.length === 0 ? [] : [...readable, 'off'], player.captions);
}

// Whose values are the page's own.
function showChoices(player) {
  for (const what of ['caption_size', 'caption_contrast', 'descriptions', 'reduced_motion']) {
    const select = document.querySelector(`select[data-do="${what}"]`);
    if (document.activeElement !== select) {
      select.value = String(player[what]);
    }
    select.closest('label').hidden = player[what] === null;
  }
}

function showWarnings(warnings) {
  const items = warnings.map((warning) => {
    const item = document.createElement('li');
    const when = document.createElement('small');
    const times = warning.times > 1 ? ` (${warning.times}×)` : '';
    when.textContent = words.ago.replace('{}', span(warning.seconds_ago)) + times;
    item.append(warning.text, when);
    item.classList.toggle('bad', warning.error);
    return item;
  });
  if (items.length === 0) {
    const none = document.createElement('li');
    none.textContent = words.no_warnings;
    items.push(none);
  }
  byId('warnings').replaceChildren(...items.reverse());
}

function statusOf(state) {
  if (!state.player) {
    return [words.starting, ''];
  }
  if (!state.answers) {
    return [`${words.no_answer}, ${words.silent_for} ${span(state.silent_seconds)}`, 'bad'];
  }
  const there = state.player.visitor;
  return there === null ? [words.plays, 'good'] : there ? [words.playing, 'good'] : [words.idle, ''];
}

function showPlayer(player) {
  byId('title').textContent = player.title;
  document.title = player.title;
  put('place', player.tracking.state === 'searching' ? '–' : player.place);
  put('show-time', player.length === null ? clock(player.seconds)
    : `${clock(player.seconds)} / ${clock(player.length)}`);
  put('tracked-minute', percent(player.tracking.tracked_minute));
  put('tracked-all', percent(player.tracking.tracked));
  put('confidence', player.tracking.state === 'tracking' ? percent(player.tracking.confidence) : '–');
  put('losses', String(player.tracking.losses));
  showTracking(player.tracking);
  showMachine(player);
  showSound(player);
  showChoices(player);
  showWarnings(player.warnings);
  byId('begin-again').hidden = !player.kiosk;
}

function showControls(state) {
  const locked = state.pin.locked_seconds;
  byId('read-only').hidden = state.pin.set;
  byId('pin-form').hidden = !state.pin.set || pin !== '';
  byId('controls').hidden = !state.pin.set || pin === '';
  byId('pin').disabled = locked > 0;
  if (locked > 0) {
    answer(`${words.locked} ${span(locked + 1)}.`);
  } else if (byId('answer').textContent.startsWith(words.locked)) {
    answer('');
  }
}

function answer(text) {
  byId('answer').textContent = text;
  byId('answer').hidden = text === '';
}

async function refresh() {
  try {
    const reply = await fetch('/state.json', {cache: 'no-store'});
    const state = await reply.json();
    put('status', ...statusOf(state));
    document.body.classList.toggle('stale', !state.answers);
    if (state.player) {
      showPlayer(state.player);
    }
    showControls(state);
  } catch {
    put('status', words.no_connection, 'bad');
  }
}

// Only while somebody looks at the page: each picture is made for who asks.
async function refreshPicture() {
  let wait = kPictureMs;
  if (!document.hidden) {
    try {
      const reply = await fetch('/mirror.jpg', {cache: 'no-store'});
      const picture = byId('picture');
      if (reply.ok) {
        URL.revokeObjectURL(picture.src);
        picture.src = URL.createObjectURL(await reply.blob());
      } else {
        wait = kPictureMs / 4;
      }
      picture.hidden = !reply.ok && picture.src === '';
      byId('no-picture').hidden = !picture.hidden;
    } catch {
      byId('picture').hidden = true;
      byId('no-picture').hidden = false;
    }
  }
  setTimeout(refreshPicture, wait);
}

async function refreshDays() {
  try {
    const reply = await fetch('/statistics.csv', {cache: 'no-store'});
    byId('statistics').hidden = !reply.ok;
    byId('no-statistics').hidden = reply.ok;
    if (reply.ok) {
      const lines = (await reply.text()).trim().split('\r\n').slice(1);
      byId('days').replaceChildren(...lines.slice(-kDaysShown).reverse().map((line) => {
        const [day, visitors, minutes, completed, tracked, , restarts] = line.split(',');
        const row = document.createElement('tr');
        const date = new Date(`${day}T12:00:00`);
        const name = date.toLocaleDateString(language, {weekday: 'short', day: 'numeric'});
        const share = tracked === '' ? '–' : percent(Number(tracked));
        for (const text of [name, visitors, number(Number(minutes), 0), completed, share, restarts]) {
          row.insertCell().textContent = text;
        }
        return row;
      }));
    }
  } catch {
    // The status says it.
  }
}

// Whether it was done; says why where it was not.
async function post(path, body) {
  try {
    const reply = await fetch(path, {
      method: 'POST',
      headers: {'Content-Type': 'application/json', 'X-Staff-Pin': pin},
      body,
    });
    if (reply.status === 401) {
      pin = '';
      answer(words.wrong_pin);
    } else if (reply.status === 429) {
      pin = '';
    } else {
      answer(reply.ok ? '' : `${words.not_done} ${await reply.text()}`);
    }
    return reply.ok;
  } catch {
    answer(words.no_connection);
    return false;
  }
}

async function tell(what, value) {
  await post('/command', JSON.stringify(value === undefined ? {do: what} : {do: what, value}));
  setTimeout(refresh, 300);
}

byId('pin-form').addEventListener('submit', async (event) => {
  event.preventDefault();
  pin = byId('pin').value;
  byId('pin').value = '';
  if (!(await post('/pin', ''))) {
    pin = '';
  }
  refresh();
});
byId('lock').addEventListener('click', () => {
  pin = '';
  refresh();
});
for (const button of document.querySelectorAll('button[data-do]')) {
  button.addEventListener('click', () => {
    if (!button.dataset.sure || confirm(words[button.dataset.sure])) {
      tell(button.dataset.do);
    }
  });
}
for (const select of document.querySelectorAll('select[data-do]')) {
  select.addEventListener('change', () => {
    select.blur();
    tell(select.dataset.do, 'switch' in select.dataset ? select.value === 'true' : select.value);
  });
}

refresh();
refreshPicture();
refreshDays();
setInterval(refresh, kStateMs);
setInterval(refreshDays, kDaysMs);
