// The visitor's menu: a dialog with a line for each choice that the show offers.
import {OFF} from './choices.js';
import {menuText, nameOf, sentence} from './texts.js';

const dialog = document.getElementById('menu');

const indexed = (texts) => texts.map((text, i) => [String(i), text]);

// The lines as {key, label, options: [value, text], value}.
function linesOf(about, values) {
  const lines = [];
  if (about.spoken.length > 1) {
    lines.push({key: 'spoken', label: menuText('language'), options: about.spoken.map(languageOption), value: values.spoken || about.spoken[0]});
  }
  if (about.captions.length > 0) {
    lines.push({key: 'captions', label: menuText('captions'), options: [...about.captions.map(languageOption), [OFF, menuText('off')]],
      value: values.captions || about.captions[0]});
  }
  lines.push({key: 'size', label: menuText('caption_size'), options: indexed(menuText('sizes')), value: String(values.size)});
  lines.push({key: 'contrast', label: menuText('contrast'), options: indexed(menuText('contrasts')), value: String(values.contrast)});
  if (about.descriptions) {
    lines.push({key: 'descriptions', label: menuText('descriptions'), options: indexed(menuText('switches')),
      value: String(Number(values.descriptions))});
  }
  lines.push({key: 'reducedMotion', label: menuText('motion'), options: indexed(menuText('motions')), value: String(Number(values.reducedMotion))});
  return lines;
}

const READ = {size: Number, contrast: Number, descriptions: (value) => value === '1', reducedMotion: (value) => value === '1'};

// options: [value, text] or, for a language, [value, text, language].
export function fillSelect(select, options, value) {
  select.replaceChildren(...options.map(([option, text, lang = '']) =>
    Object.assign(new Option(text, option, false, option === value), lang === '' ? {} : {lang})));
}

export const languageOption = (language) => [language, nameOf(language), language];

// act: {change(values), restart(), findAnew()}. values: those of Choices, whose languages the show has.
export function fillMenu(about, values, act) {
  const focused = document.activeElement?.dataset.key;
  const rows = linesOf(about, values).map(({key, label, options, value}) => {
    const select = document.createElement('select');
    select.dataset.key = key;
    fillSelect(select, options, value);
    select.onchange = () => act.change({[key]: (READ[key] ?? String)(select.value)});
    return row(label, select);
  });
  const volume = Object.assign(document.createElement('input'), {type: 'range', min: 0, max: 10, value: Math.round(10 * values.volume)});
  volume.dataset.key = 'volume';
  volume.oninput = () => act.change({volume: volume.value / 10});
  rows.push(row(sentence('volume'), volume));
  document.getElementById('choices').replaceChildren(...rows);
  document.getElementById('restart').onclick = () => closing(act.restart);
  document.getElementById('find_anew').onclick = () => closing(act.findAnew);
  document.querySelector(`#choices [data-key="${focused}"]`)?.focus();
}

function row(label, control) {
  const line = document.createElement('label');
  const name = document.createElement('span');
  name.textContent = label;
  line.append(name, control);
  return line;
}

function closing(act) {
  dialog.close();
  act();
}

export const openMenu = () => dialog.showModal();
export const closeMenu = () => dialog.close();
