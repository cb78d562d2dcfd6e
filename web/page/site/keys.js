// Keys of the keyboard for the drama.
const NAMES = {Space: 'space', Enter: 'enter', Escape: 'escape', ArrowLeft: 'left', ArrowRight: 'right', ArrowUp: 'up', ArrowDown: 'down',
  PageUp: 'page_up', PageDown: 'page_down', Home: 'home'};

// The name of a key as the player calls it (render::KeyName); undefined: the drama does not know the key, or it belongs to
// the browser or to the element that has the focus. event: of the type keydown.
export function keyOf({code, target, ctrlKey, altKey, metaKey, repeat}) {
  const pressesButton = target.matches('button') && (code === 'Space' || code === 'Enter');
  if (ctrlKey || altKey || metaKey || repeat || pressesButton || target.matches('input, select')) {
    return undefined;
  }
  const name = /^(?:Key|Digit)(.)$|^(F(?:[1-9]|1[0-2]))$/.exec(code);
  return NAMES[code] ?? (name?.[1] ?? name?.[2])?.toLowerCase();
}
