// The report: what devices counted on the days from one to another, added up. Devices leave out counts of fewer than ten visits
// before they publish, so a sum is at least what it says.
'use strict';

const kMostStatistics = 65536;  // bytes
const kMostCount = 1e9;
const kLeastVisits = 10;  // Devices tell only the number of visits of a day that had fewer.
const kLengthMinutes = [1, 2, 5, 10, 20];
const kDay = /^\d{4}-\d{2}-\d{2}$/;
const kTag = /^[A-Za-z0-9-]{1,64}$/;
const kPlaceName = /^[\w-]{1,64}$/;
const kBarHeight = 26;
const kBarBegin = 110;
const kBarLength = 170;
// The days of each device by their dates, by the names of devices; null: not understood.
const statistics = new Map();

// --- What devices published

function requireThat(condition) {
  if (!condition) {
    throw new Error('not as docs/file-formats.md has it');
  }
}

function count(value, least = 0, most = kMostCount) {
  requireThat(Number.isInteger(value) && value >= least && value <= most);
  return value;
}

function counts(list, most) {
  requireThat(Array.isArray(list) && list.length <= most);
  return list.map((value) => count(value));
}

function countsByTag(object) {
  requireThat(typeof object === 'object' && object !== null && !Array.isArray(object));
  const entries = Object.entries(object);
  requireThat(entries.length <= 32 && entries.every(([tag]) => kTag.test(tag)));
  return entries.map(([tag, value]) => [tag, count(value)]);
}

function parseDay(day) {
  requireThat(kDay.test(day.day) && Array.isArray(day.lost ?? []) && (day.lost ?? []).length <= 200);
  const total = ['visitors', 'completed', 'losses', 'restarts', 'played_seconds', 'seen_seconds', 'tracked_seconds'];
  return {
    ...Object.fromEntries(total.map((name) => [name, count(day[name])])),
    lengths: counts(day.lengths ?? [], kLengthMinutes.length + 1),
    ended: counts(day.ended ?? [], 61),
    languages: countsByTag(day.languages ?? {}),
    captions: countsByTag(day.captions ?? {}),
    lost: (day.lost ?? []).map(({place, x, z, visits}) => {
      requireThat(kPlaceName.test(place));
      return [`${place} ${count(x, -1000, 1000)} ${count(z, -1000, 1000)}`, count(visits)];
    }),
  };
}

function takeStatistics(name, payload) {
  try {
    requireThat(payload.length <= kMostStatistics);
    const {schema, days} = JSON.parse(new TextDecoder('utf-8', {fatal: true}).decode(payload));
    requireThat(schema === 1 && Array.isArray(days) && days.length <= 400);
    statistics.set(name, new Map(days.map((day) => [day.day, parseDay(day)])));
  } catch {
    statistics.set(name, null);
  }
  statistics.changed = true;
}

function forgetStatistics(name) {
  statistics.delete(name);
  statistics.changed = true;
}

// --- Sums

const sum = (values) => values.reduce((a, b) => a + b, 0);
const addTo = (map, key, value) => map.set(key, (map.get(key) ?? 0) + value);

// The days of the devices that are shown, as [device, day, counts].
function chosenDays() {
  const [from, to] = [byId('from').value, byId('to').value];
  return shownDevices().flatMap(({name}) => [...statistics.get(name) ?? []]
    .filter(([day]) => day >= from && day <= to).map(([day, value]) => [name, day, value]));
}

function sumOf(days) {
  const told = days.filter(({visitors}) => visitors >= kLeastVisits);
  const total = (name, of = told) => sum(of.map((day) => day[name]));
  const bins = (name, size) => Array.from({length: size}, (_, i) => sum(told.map((day) => day[name][i] ?? 0)));
  const byKey = (name) => {
    const map = new Map();
    told.forEach((day) => day[name].forEach(([key, value]) => addTo(map, key, value)));
    return map;
  };
  return {
    visitors: total('visitors', days), told: total('visitors'), completed: total('completed'), losses: total('losses'),
    restarts: total('restarts', days), played: total('played_seconds'), seen: total('seen_seconds'), tracked: total('tracked_seconds'),
    lengths: bins('lengths', kLengthMinutes.length + 1), ended: bins('ended', 61), languages: byKey('languages'),
    captions: byKey('captions'), lost: byKey('lost'),
  };
}

// --- Pictures

function lengthName(i) {
  const [from, to] = [kLengthMinutes[i - 1], kLengthMinutes[i]];
  return from === undefined ? `< ${to} min` : to === undefined ? `≥ ${from} min` : `${from}–${to} min`;
}
const minuteName = (i) => i === 60 ? '≥ 60 min' : `${i}–${i + 1} min`;

// A count that devices left out may still be some visits.
const valueName = (value) => value === 0 ? '–' : number(value, 0);

// Bars of [name, count], one below another.
function drawBars(id, bars) {
  const picture = byId(id);
  const largest = Math.max(1, ...bars.map(([, value]) => value));
  picture.closest('figure').querySelector('.nothing').hidden = bars.length > 0;
  picture.toggleAttribute('hidden', bars.length === 0);
  picture.setAttribute('viewBox', `0 0 ${kBarBegin + kBarLength + 60} ${kBarHeight * Math.max(1, bars.length)}`);
  picture.setAttribute('aria-label', bars.map(([name, value]) => `${name}: ${valueName(value)}`).join(', ') || words.nothing_told);
  picture.replaceChildren(...bars.flatMap(([name, value], i) => {
    const length = kBarLength * value / largest;
    const y = kBarHeight * (i + 0.7);
    return [
      svg('text', {x: kBarBegin - 8, y, 'text-anchor': 'end'}, name.slice(0, 20)),
      svg('rect', {x: kBarBegin, y: kBarHeight * i + 4, width: length, height: kBarHeight - 8}),
      svg('text', {x: kBarBegin + length + 6, y}, valueName(value)),
    ];
  }));
}

const largestFirst = (map, name) => [...map].sort((a, b) => b[1] - a[1]).map(([key, value]) => [name(key), value]);
// Leaves out the empty bars at both ends.
function between(values, name) {
  const last = values.findLastIndex((value) => value > 0);
  return values.map((value, i) => [name(i), value]).slice(Math.max(0, values.findIndex((value) => value > 0)), last + 1);
}

function drawLost(lost) {
  const cells = [...lost].map(([key, visits]) => {
    const [place, x, z] = key.split(' ');
    return {place, x: Number(x), z: Number(z), visits};
  });
  offer(byId('lost-place'), distinct(cells.map(({place}) => place)), (place) => place);
  const place = byId('lost-place').value;
  const here = cells.filter((cell) => cell.place === place);
  const picture = byId('lost');
  picture.closest('figure').querySelector('.nothing').hidden = here.length > 0;
  picture.toggleAttribute('hidden', here.length === 0);
  byId('lost-place').closest('label').hidden = here.length === 0;
  if (here.length === 0) {
    return;
  }
  const points = plans[place]?.points ?? [];
  const [xs, zs] = [0, 1].map((axis) => [...points.map((point) => point[axis]), -1, 1]);
  const bounds = [least([...xs, ...here.map(({x}) => x)]), most([...xs, ...here.map(({x}) => x + 1)]),
    least([...zs, ...here.map(({z}) => z)]), most([...zs, ...here.map(({z}) => z + 1)])];
  const largest = Math.max(...here.map(({visits}) => visits));
  picture.setAttribute('viewBox', viewOf(...bounds));
  picture.setAttribute('aria-label', here.map(({x, z, visits}) => `x ${x}, z ${z}: ${visits}`).join('; '));
  picture.replaceChildren(...floorOf(...bounds, plans[place] ?? {}), ...here.flatMap(({x, z, visits}) => [
    svg('rect', {x, y: z, width: 1, height: 1, 'fill-opacity': 0.15 + 0.35 * visits / largest}),
    svg('text', {x: x + 0.5, y: z + 0.62, 'text-anchor': 'middle', 'font-size': 0.28}, number(visits, 0)),
  ]));
}

// --- The table and the file

function rowOf(name, days) {
  const total = sumOf(days);
  const few = (text) => total.told === 0 ? '–' : text;
  return [name, number(total.visitors, 0), few(number(total.played / 60, 0)), few(number(total.played / 60 / total.told, 1)),
    few(number(total.completed, 0)), total.seen === 0 ? '–' : percent(Math.min(1, total.tracked / total.seen)),
    few(number(total.losses, 0)), number(total.restarts, 0)];
}

function fillTable(days) {
  const names = distinct(days.map(([name]) => name));
  const of = (name) => days.filter(([device]) => device === name).map(([, , value]) => value);
  const rows = [rowOf(words.all, days.map(([, , value]) => value)), ...names.map((name) => rowOf(name, of(name)))];
  byId('report-rows').replaceChildren(...rows.map(([name, ...texts]) => {
    const row = document.createElement('tr');
    const head = document.createElement('th');
    head.scope = 'row';
    head.textContent = name;
    row.append(head);
    texts.forEach((text) => { row.insertCell().textContent = text; });
    return row;
  }));
}

// Writes one count a line (RFC 4180), so that tables of any form can be made of it.
function csvOf(days) {
  const lines = [['day', 'device', 'what', 'which', 'count']];
  for (const [name, day, value] of days) {
    const add = (what, which, number) => lines.push([day, name, what, which, number]);
    add('visits', '', value.visitors);
    add('restarts', '', value.restarts);
    if (value.visitors >= kLeastVisits) {
      add('played_seconds', '', value.played_seconds);
      add('seen_to_the_end', '', value.completed);
      add('seen_seconds', '', value.seen_seconds);
      add('tracked_seconds', '', value.tracked_seconds);
      add('losses', '', value.losses);
    }
    const told = (what, entries) => entries.filter(([, number]) => number > 0).forEach(([which, number]) => add(what, which, number));
    told('visits_by_length', value.lengths.map((number, i) => [lengthName(i), number]));
    told('visits_by_minute_of_end', value.ended.map((number, i) => [minuteName(i), number]));
    told('visits_by_language', value.languages);
    told('visits_by_captions', value.captions);
    told('visits_that_lost_tracking', value.lost);
  }
  return '\ufeff' + lines.map((line) => line.map((text) => `"${text}"`).join(',') + '\r\n').join('');
}

function save() {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([csvOf(chosenDays())], {type: 'text/csv'}));
  link.download = `${site}-${byId('from').value}-${byId('to').value}.csv`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function showReport() {
  const names = shownDevices().map(({name}) => name).join(' ');
  if (!statistics.changed && statistics.names === names) {
    return;
  }
  statistics.changed = false;
  statistics.names = names;
  const known = distinct([...statistics.values()].flatMap((days) => [...days?.keys() ?? []]));
  for (const id of ['from', 'to']) {
    byId(id).min = known[0] ?? '';
    byId(id).max = known.at(-1) ?? '';
    byId(id).value ||= known.at(-1) ?? '';
  }
  const damaged = [...statistics].filter(([, days]) => days === null).map(([name]) => name);
  byId('not-understood').hidden = damaged.length === 0;
  update(byId('not-understood'), words.statistics_damaged.replace('{}', damaged.join(', ')), 'bad');
  const days = chosenDays();
  const total = sumOf(days.map(([, , value]) => value));
  const devices = distinct(days.map(([name]) => name)).length;
  update(byId('report-sum'), words.report_sum.replace('{visits}', number(total.visitors, 0)).replace('{devices}', devices));
  drawBars('lengths', total.lengths.some((value) => value > 0) ? total.lengths.map((value, i) => [lengthName(i), value]) : []);
  drawBars('ended', between(total.ended, minuteName));
  drawBars('spoken', largestFirst(total.languages, languageName));
  drawBars('read', largestFirst(total.captions, languageName));
  drawLost(total.lost);
  fillTable(days);
  byId('save').disabled = days.length === 0;
}

function listenToReport() {
  for (const id of ['from', 'to', 'lost-place']) {
    byId(id).addEventListener('change', () => {
      statistics.changed = true;
      showReport();
    });
  }
  byId('period').addEventListener('submit', (event) => event.preventDefault());
  byId('save').addEventListener('click', save);
  byId('print').addEventListener('click', () => print());
}
