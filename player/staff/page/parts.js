// What pages for the staff share: texts and numbers as their reader's language has them. A page defines `words`, its texts
// by their keys, and `language`.
'use strict';

const byId = (id) => document.getElementById(id);
// Formats are made once, because making one takes longer than using it a hundred times.
const formats = new Map();
function formatOf(key, make) {
  if (!formats.has(key)) {
    formats.set(key, make());
  }
  return formats.get(key);
}
const percent = (share) => share === null ? '–'
  : formatOf('percent', () => new Intl.NumberFormat(language, {style: 'percent'})).format(share);
const number = (value, digits) =>
  formatOf(digits, () => new Intl.NumberFormat(language, {minimumFractionDigits: digits, maximumFractionDigits: digits}))
    .format(value);

// 75 as "1:15", 4000 as "1:06:40".
function clock(seconds) {
  const whole = Math.max(0, Math.floor(seconds));
  const two = (value) => String(value).padStart(2, '0');
  const minutes = Math.floor(whole / 60) % 60;
  const hours = Math.floor(whole / 3600);
  return (hours > 0 ? `${hours}:${two(minutes)}` : String(minutes)) + ':' + two(whole % 60);
}

// Writes a time span as people say it: "45 s", "12 min", "3 h 20 min".
function span(seconds) {
  if (seconds < 60) {
    return `${Math.floor(seconds)} s`;
  }
  const minutes = Math.floor(seconds / 60);
  return minutes < 60 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

function languageName(code) {
  if (code === '') {
    return words.authors_choice;
  }
  if (code === 'off') {
    return words.off;
  }
  try {
    return formatOf('language', () => new Intl.DisplayNames([language], {type: 'language'})).of(code);
  } catch {
    return code;
  }
}

function fill(select, codes, chosen) {
  const wanted = codes.join(' ');
  if (select.dataset.codes !== wanted) {
    select.dataset.codes = wanted;
    select.replaceChildren(...codes.map((code) => new Option(languageName(code), code)));
  }
  if (document.activeElement !== select) {
    select.value = chosen === '' ? codes[0] : chosen;
  }
  select.closest('label').hidden = codes.length < 2;
}
