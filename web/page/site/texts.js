// The page's texts in the languages that the program knows (shared/show/visitor_texts.json).
import TEXTS from './visitor_texts.js';

const RIGHT_TO_LEFT = ['ar', 'dv', 'fa', 'he', 'ku', 'ps', 'sd', 'ug', 'ur', 'yi'];
const plain = (language) => language.split('-')[0];

export const KNOWN = Object.keys(TEXTS);
let language = 'en';

// Returns the first of some languages that has texts; '' if none has.
export const firstKnown = (languages) => languages.map(plain).find((tag) => TEXTS[tag] !== undefined) ?? '';
// The name of a language in that language, or its tag.
export const nameOf = (tag) => TEXTS[plain(tag)]?.name ?? tag;
export const directionOf = (tag) => RIGHT_TO_LEFT.includes(plain(tag)) ? 'rtl' : 'ltr';

// Chooses the language of all texts, and writes those that belong to elements: data-text names a sentence of the page,
// data-menu one of the menu, data-label the name of an element that is not seen.
export function setLanguage(tag) {
  language = plain(tag);
  Object.assign(document.documentElement, {lang: language, dir: directionOf(language)});
  document.querySelectorAll('[data-text]').forEach((element) => element.textContent = sentence(element.dataset.text));
  document.querySelectorAll('[data-menu]').forEach((element) => element.textContent = menuText(element.dataset.menu));
  document.querySelectorAll('[data-label]').forEach((element) => element.setAttribute('aria-label', sentence(element.dataset.label)));
}

export const sentence = (name) => TEXTS[language].page[name];
export const menuText = (name) => TEXTS[language].menu[name];
