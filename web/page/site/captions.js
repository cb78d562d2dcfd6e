// Captions and the guide's words, over the picture.
import {sentence} from './texts.js';

const hex = (colour) => `rgb(${colour.map((part) => Math.round(255 * part)).join(' ')})`;

// The name of the side on which a speaker is out of view, which render::CaptionSide numbers; undefined for one in view.
const nameOfSide = (side) => [undefined, 'left', 'right'][side];

// An arrow to that side; '' for a speaker in view.
export const sideOf = (side) => ({left: '◀', right: '▶'})[nameOfSide(side)] ?? '';

function lineOf({speaker, colour, side, text}) {
  const line = document.createElement('p');
  line.dir = 'auto';
  if (speaker !== '') {
    const name = document.createElement('b');
    name.textContent = speaker;
    name.style.color = hex(colour);
    line.append(name, ' ');
    if (sideOf(side) !== '') {
      const arrow = document.createElement('span');
      arrow.className = 'side';
      arrow.textContent = `${sideOf(side)} `;
      arrow.setAttribute('role', 'img');
      arrow.setAttribute('aria-label', sentence(nameOfSide(side)));
      line.prepend(arrow);
    }
  }
  line.append(text);
  return line;
}

// texts: see PageShow::TakeTexts(). language: of the show's texts; '' if it has none.
export function showTexts({captions, guide, hint}, language) {
  const [lines, words] = ['captions', 'hint'].map((id) => document.getElementById(id));
  for (const element of [lines, words]) {
    element.lang = language;
  }
  lines.replaceChildren(...captions.map(lineOf).reverse());
  if (words.textContent !== hint) {
    words.textContent = hint;
  }
  words.className = guide;
}
