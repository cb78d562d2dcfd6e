// What a visitor has chosen, which the browser keeps.
import {firstKnown} from './texts.js';

const KEY = 'lararium';
// A visitor who chooses this as the language of captions sees none.
export const OFF = 'off';

const prefers = (what) => matchMedia(what).matches;

function readKept() {
  try {
    return JSON.parse(localStorage.getItem(KEY)) ?? {};
  } catch {
    return {};  // The browser may forbid storage, or its content may be another program's.
  }
}

export class Choices {
  constructor() {
    this.kept = readKept();
  }

  // page: language of the page's own texts. spoken, captions: '' is the author's choice. size: 0 to 2. volume: 0 to 1.
  get values() {
    return {
      page: firstKnown(navigator.languages) || 'en', spoken: '', captions: '', size: 0, contrast: prefers('(prefers-contrast: more)') ? 1 : 0,
      descriptions: false, reducedMotion: prefers('(prefers-reduced-motion: reduce)'), volume: 1, ...this.kept,
    };
  }

  change(values) {
    Object.assign(this.kept, values);
    try {
      localStorage.setItem(KEY, JSON.stringify(this.kept));
    } catch {
      // Without storage they hold for this visit.
    }
  }

  // The languages for a show: what it does not have is left to its author. about: see Folder.
  languagesFor({spoken, captions}) {
    const {values} = this;
    const has = (all, one) => all.includes(one) ? one : '';
    return {
      spoken: has(spoken, values.spoken),
      captions: values.captions === OFF ? OFF : has(captions, values.captions || values.page),
      read: has(captions, values.page),
    };
  }
}
