// A visit: title, permission, show, end, and what stands in its way.
import {openCamera, Problem, readImage} from './camera.js';
import {showTexts} from './captions.js';
import {Choices, OFF} from './choices.js';
import {compilePrograms, Folder} from './folder.js';
import {keep} from './keep.js';
import {keyOf} from './keys.js';
import {closeMenu, fillMenu, fillSelect, languageOption, openMenu} from './menu.js';
import {Place} from './place.js';
import {canShowRoom, Room} from './room.js';
import {DRAMA, GUIDE, LANGUAGES, PERSON, Show, SHOW, THINGS, VOICES} from './show.js';
import {Sound} from './sound.js';
import {firstKnown, KNOWN, menuText, sentence, setLanguage} from './texts.js';

const FRAME_SECONDS = 1 / 30;
const FADE_SECONDS = 2;  // People and sound fade for so long when the story is over, as in the player.
const element = (id) => document.getElementById(id);
const [card, text, progress, rest, go, video, canvas] = ['card', 'text', 'progress', 'rest', 'go', 'video', 'lararium'].map(element);

// --- Screens

function setPlaying(playing) {
  card.hidden = playing;
  document.body.classList.toggle('playing', playing);
  element('open_menu').hidden = !playing;
  element('over').hidden = !playing;
  if (playing) {
    element('open_menu').focus();
  } else {
    closeMenu();
  }
}

// Shows a sentence over the picture, and a button that goes on; without `act` there is no button.
function showCard(sentence, label, act) {
  setPlaying(false);
  text.textContent = sentence;
  progress.hidden = true;
  element('sound').hidden = true;
  element('language_row').hidden = true;
  go.hidden = act === undefined;
  element('without_camera').hidden = act !== start;
  if (act !== undefined) {
    go.textContent = label;
    go.onclick = act;
    go.focus();
  }
}

function showProgress(share) {
  progress.hidden = false;
  if (share < 1) {
    progress.value = share;
  } else {
    progress.removeAttribute('value');
  }
}

function showProblem(error) {
  if (error instanceof Problem) {
    showCard(error.message, sentence('again'), start);
  } else {
    console.error(error);
    showCard(`${sentence('failed')} ${error?.message ?? String(error)}`, sentence('reload'), () => location.reload());
  }
}

function showTitle() {
  setPlaying(false);
  text.textContent = sentence('intro');
  go.textContent = sentence('start');
  go.onclick = start;
  element('without_camera').hidden = false;
  element('sound').hidden = about !== undefined && !about.sounds;
  const languages = about?.captions.length > 0 ? about.captions : KNOWN;
  const {values} = choices;
  const chosen = languages.find((language) => language === (values.captions || values.page)) ?? languages[0];
  fillSelect(element('language'), languages.map(languageOption), chosen);
  element('language_row').hidden = languages.length < 2;
}

function showEnd() {
  showCard(sentence('over'), menuText('restart'), () => {
    visitable.show.restart();
    begin();
  });
}

// --- Choices

const choices = new Choices();
const sound = new Sound();
let about;  // Folder.about; undefined until the folder has been opened.

// Writes everything in the language that was chosen.
function writeTexts() {
  const {values} = choices;
  setLanguage(values.page);
  if (about === undefined) {
    element('title').textContent = sentence('title');
    return;
  }
  document.title = element('title').textContent = about.title;
  fillMenu(about, {...values, ...choices.languagesFor(about)}, {change, restart, findAnew});
}

function applyChoices() {
  const {values} = choices;
  Object.assign(document.documentElement.dataset, {size: values.size, contrast: values.contrast});
  visitable?.show.choose(values);
  sound.setVolume(values.volume);
}

// The staff changes something; then the menu shows it.
function changeFromOutside(values) {
  change(values);
  writeTexts();
}

// The page's own texts are in the captions' language, where it is known.
function change(values) {
  const page = values.captions && values.captions !== OFF ? firstKnown([values.captions]) : '';
  choices.change(page === '' ? values : {...values, page});
  applyChoices();
  if ('spoken' in values || 'captions' in values) {
    writeTexts();
    if (visitable !== undefined) {
      changeLanguages();
    }
  }
}

// Fetches the texts and voices of other languages; then the picture stands while they are loaded.
async function changeLanguages() {
  element('hint').textContent = sentence('changing');
  try {
    const {show, folder} = visitable;
    await loadFirst();
    const languages = choices.languagesFor(about);
    await folder.supply(show, LANGUAGES, languages);
    await new Promise((resolve) => setTimeout(resolve, 50));  // The page is drawn before it is busy.
    show.setLanguages(languages);
    openSound(show);
    show.choose(choices.values);
    element('hint').textContent = '';
  } catch (error) {
    stop(() => showProblem(error));
  }
}

function restart() {
  visitable.show.restart();
}

function findAnew() {
  visitable.place.relocalize();
  visitable.show.forgetPose();
}

// Without sound the show goes on.
function openSound(show) {
  if (sound.out !== undefined) {
    try {
      show.openSound(sound.out);
    } catch (error) {
      console.warn(error);
    }
  }
}

// --- Loading

const nextTask = () => new Promise((resolve) => setTimeout(resolve));  // The page is drawn before it is busy.

// Counts bytes for a progress bar. onshare: takes the share of all bytes that has arrived.
function counting(all, onshare) {
  let received = 0;
  return (count) => onshare(Math.min((received += count) / all, 1));
}

// A function that loads once; after a failure, its next call tries again.
function once(load) {
  let loading;
  return () => {
    loading ??= load().catch((error) => {
      loading = undefined;
      throw error;
    });
    return loading;
  };
}

const openFolder = once(async () => {
  const folder = await Folder.open();
  ({about} = folder);
  writeTexts();
  return folder;
});

const fetchPrograms = once(compilePrograms);

// Loads what tracking and the guide need.
const load = once(async () => {
  const [folder, [program, trackerProgram]] = await Promise.all([openFolder(), fetchPrograms()]);
  const show = await folder.openShow(Show, program);
  const languages = choices.languagesFor(about);
  await folder.supply(show, GUIDE, languages, counting(folder.bytesOf(show, GUIDE, languages), showProgress));
  const place = new Place(show.maps(), trackerProgram);
  showProgress(1);
  await nextTask();
  show.load(GUIDE, languages);
  await place.ready;
  place.ontracked = drawTracked;
  place.onerror = (error) => stop(() => showProblem(error));
  visitable = {show, place, folder, fleet: await joinFleet(show)};
  applyChoices();
  canvas.dataset.shows = 'guide';
  return visitable;
});

// The fleet of a museum, if the folder names one. The show plays without it, too.
async function joinFleet(show) {
  if (about.fleet === undefined) {
    return undefined;
  }
  try {
    const {Fleet} = await import('./fleet.js');
    return new Fleet(about.fleet, {about, show, choices, sound, change: changeFromOutside, restart, findAnew});
  } catch (error) {
    console.warn(error);
    return undefined;
  }
}

function showRest(share) {
  if (card.hidden) {
    rest.hidden = share >= 1;
    rest.value = share;
  } else {
    showProgress(share);
  }
}

// Begins the drama, while the camera already looks for the place. People follow.
const loadDrama = once(async () => {
  const {show, place, folder} = await load();
  const languages = choices.languagesFor(about);
  const onbytes = counting(folder.bytesOf(show, SHOW, languages), showRest);
  await folder.supply(show, DRAMA, languages, onbytes);
  await nextTask();
  show.load(DRAMA, languages);
  place.setOccluders(show.occluders());
  applyChoices();
  openSound(show);
  canvas.dataset.people = 0;
  return {show, folder, languages, onbytes};
});

// Lets the next person appear. Returns false if all are there.
async function bringPerson({show, folder, languages, onbytes}) {
  if (!await folder.supply(show, PERSON, languages, onbytes)) {
    return false;
  }
  await nextTask();
  show.loadPeople();
  ++canvas.dataset.people;
  return true;
}

let onPicture = () => {};  // Called after each picture.

// Brings the first person, whom the first picture of the drama chooses, then things and voices.
const loadFirst = once(async () => {
  const drama = await loadDrama();
  const {show, folder, languages, onbytes} = drama;
  await new Promise((resolve) => {
    onPicture = resolve;
  });
  await bringPerson(drama);
  if (await folder.supply(show, THINGS, languages, onbytes)) {
    await nextTask();
    show.loadThings();
  }
  if (await folder.supply(show, VOICES, languages, onbytes)) {
    await nextTask();
    show.loadVoices(languages);
    openSound(show);
  }
});

// Loads all that is missing, then keeps the folder on the device.
const loadRest = once(async () => {
  await loadFirst();
  const drama = await loadDrama();
  while (await bringPerson(drama)) {}
  rest.hidden = true;
  canvas.dataset.shows = 'show';
  keep(drama.folder, drama.show, choices.languagesFor(about));
});

// The show and its place, as soon as they are loaded.
let visitable;

// --- Playing

// The visit that plays now: show, place, and the camera's stream, or the room that the device shows; a walk has neither. undefined:
// nothing plays.
let visit;
// What goes on after an interruption: start or startWalk.
let begin = start;
let texts = {captions: [], guide: '', hint: ''};  // The texts over the last picture.

// The image that is being tracked: {number, seconds, lateMs}, or {number, viewer} in a room.
let image = {number: 0};
// Seconds of the show's frames, which go on where they were when the camera starts again.
let seconds = 0;
// The callback that waits for the camera's next image.
let awaited = 0;

function awaitFrame() {
  awaited = video.requestVideoFrameCallback(trackFrame);
}

function beginSound() {
  sound.begin();
  sound.setVolume(choices.values.volume);
}

async function start() {
  begin = start;
  beginSound();
  showCard(sentence('loading'));
  let mine;
  try {
    const loaded = load();
    // If the camera fails, nothing waits for `loaded`, whose error must not count as unhandled then.
    loaded.catch(() => {});
    const stream = await openCamera();
    try {
      visit = mine = {...await loaded, stream, begun: undefined, presented: 0};
    } catch (error) {
      stream.getTracks().forEach((track) => track.stop());
      throw error;
    }
    const [track] = stream.getVideoTracks();
    track.onended = track.onmute = () => stop(() => showCard(sentence('stopped'), sentence('again'), start));
    video.srcObject = stream;
    await video.play();
    play(mine, awaitFrame);
    loadRest().catch((error) => stop(() => showProblem(error)));
  } catch (error) {
    // If another visit plays or this one was stopped, a sentence says so already.
    if (mine === visit) {
      stop(() => showProblem(error));
    }
  }
}

function play(mine, next) {
  navigator.wakeLock?.request('screen').catch(() => {});
  if (document.hidden) {
    pause();
  } else if (visit === mine) {
    element('walk').hidden = mine.stream !== undefined || mine.room !== undefined;
    setPlaying(true);
    mine.fleet?.begin().catch((error) => console.warn(error));
    next();
  }
}

// Plays the show as it is seen from the map's keyframes, one of which a slider chooses.
async function startWalk() {
  begin = startWalk;
  beginSound();
  showCard(sentence('progress'));
  let mine;
  try {
    const loaded = await load();
    await loadDrama();
    const {viewCount} = loaded.show;
    if (viewCount === 0) {
      throw new Problem('no_camera');
    }
    element('view').max = viewCount - 1;
    visit = mine = {...loaded, stream: undefined, begun: undefined};
    play(mine, () => requestAnimationFrame((now) => drawWalk(mine, now)));
    loadRest().catch((error) => stop(() => showProblem(error)));
  } catch (error) {
    if (mine === visit) {
      stop(() => showProblem(error));
    }
  }
}

// Seconds of the show at a time of the display, in milliseconds.
function timeOf(mine, now) {
  mine.begun ??= now / 1000 - (seconds === 0 ? 0 : seconds + FRAME_SECONDS);
  return Math.max(seconds, now / 1000 - mine.begun);
}

// Milliseconds since the last picture, if the page missed one; otherwise 0.
const lateness = (passed) => passed > 2 * FRAME_SECONDS ? 1000 * passed : 0;

function drawWalk(mine, now) {
  if (mine !== visit) {
    return;
  }
  const time = timeOf(mine, now);
  const passed = time - seconds;
  if (seconds > 0 && passed < 0.9 * FRAME_SECONDS) {
    requestAnimationFrame((next) => drawWalk(mine, next));  // The display is faster than the show.
    return;
  }
  seconds = time;
  const {show} = mine;
  const view = element('view').valueAsNumber;
  drawPicture(show.viewSize(view), (left) => show.drawView(view, seconds, lateness(passed), left),
    () => requestAnimationFrame((next) => drawWalk(mine, next)));
}

// Goes on in the room that the device itself shows, from where the camera has found the place.
async function enterRoom() {
  const {found, ...loaded} = visit;
  stop(() => {});  // The device needs the camera itself.
  try {
    const room = await Room.open(loaded.show, element('over'));
    const mine = {...loaded, stream: undefined, room, found, begun: undefined};
    visit = mine;
    beginSound();
    room.texts?.set(texts, loaded.show.language, choices.values);
    loaded.show.enterRoom(room.sees);
    room.onend = pause;
    play(mine, () => awaitRoom(mine));
  } catch (error) {
    console.warn(error);
    start();
  }
}

function awaitRoom(mine) {
  mine.room.awaitFrame((now, view) => {
    if (mine === visit) {
      drawRoom(mine, now, view);
    }
  });
}

function drawRoom(mine, now, view) {
  if (view === undefined) {
    awaitRoom(mine);
    return;
  }
  const {show, room, place} = mine;
  const before = seconds;
  seconds = timeOf(mine, now);
  if (mine.found !== undefined) {
    show.findStage(mine.found, view.viewer, seconds);
    mine.found = undefined;
  }
  const pixels = mine.tracks ? undefined : room.takeImage(now);
  if (pixels !== undefined) {
    mine.tracks = true;
    image = {number: image.number + 1, viewer: view.viewer};
    place.track(image.number, show.setImage(pixels), seconds);
  }
  drawPicture(canvas, (left) => show.drawInRoom(view.views, view.framebuffer, seconds, lateness(seconds - before), left), () => {
    room.texts?.draw(view.views, view.viewer, view.framebuffer);
    awaitRoom(mine);
  });
}

// Lets the camera go, and shows what has happened.
function stop(show) {
  const stopped = visit;
  visit = undefined;
  video.cancelVideoFrameCallback(awaited);
  ++image.number;  // The answer to the image under way is ignored.
  if (stopped?.stream !== undefined) {
    stopped.stream.getVideoTracks().forEach((track) => {
      track.onended = track.onmute = null;
      track.stop();
    });
    video.srcObject = null;
  }
  if (stopped?.room !== undefined) {
    stopped.room.close();
    stopped.show.forgetPose();
  }
  element('enter_room').hidden = true;
  sound.suspend();
  stopped?.fleet?.end();
  show();
}

function pause() {
  stop(() => showCard(sentence('waits'), sentence('go_on'), begin));
}

async function trackFrame(now, {mediaTime, presentedFrames}) {
  const current = visit;
  if (current === undefined) {
    return;
  }
  // A camera that is just being closed or opened has no image.
  if (video.readyState < HTMLMediaElement.HAVE_CURRENT_DATA) {
    awaitFrame();
    return;
  }
  try {
    const pixels = await readImage(video);
    if (current !== visit) {
      return;
    }
    if (current.begun === undefined) {
      current.begun = mediaTime - (seconds === 0 ? 0 : seconds + FRAME_SECONDS);
    }
    const before = seconds;
    seconds = Math.max(seconds, mediaTime - current.begun);
    const missed = presentedFrames > current.presented + 1 && current.presented > 0;
    current.presented = presentedFrames;
    image = {number: image.number + 1, seconds, lateMs: missed ? 1000 * (seconds - before) : 0,
      width: pixels.width, height: pixels.height};
    current.place.track(image.number, current.show.setImage(pixels), seconds);
  } catch (error) {
    stop(() => showProblem(error));
  }
}

// Share of people and sound that is left when the story is over.
function shareLeft({length, time}) {
  return length > 0 ? Math.min(1, Math.max(0, 1 - (time - length) / FADE_SECONDS)) : 1;
}

// Draws a picture with its texts and goes on, or ends the visit. draw: takes the share of people that is left.
function drawPicture({width, height}, draw, next) {
  if (canvas.width !== width || canvas.height !== height) {
    Object.assign(canvas, {width, height});
  }
  try {
    const {show} = visit;
    const left = shareLeft(show);
    draw(left);
    onPicture();
    sound.setVolume(choices.values.volume * left);
    const changed = show.takeTexts();
    if (changed !== undefined) {
      texts = changed;
      showTexts(texts, show.language);
      visit.room?.texts?.set(texts, show.language, choices.values);
    }
    if (shareLeft(show) === 0) {
      stop(showEnd);
    } else {
      next();
    }
  } catch (error) {
    stop(() => showProblem(error));
  }
}

// Draws the very image that was tracked; in a room, it only tells where the stage is.
function drawTracked({number, tracked, seen}) {
  if (visit === undefined || number !== image.number) {
    return;
  }
  const {show, fleet} = visit;
  fleet?.saw(tracked);
  if (visit.room !== undefined) {
    visit.tracks = false;
    show.findStage(tracked, image.viewer, seconds);
  } else {
    visit.found = tracked.pose === null ? undefined : tracked;
    element('enter_room').hidden = !roomIsPossible || visit.found === undefined;
    drawPicture(image, (left) => show.draw(tracked, seen, image.seconds, image.lateMs, left), awaitFrame);
  }
}

document.addEventListener('visibilitychange', () => {
  if (document.hidden && visit !== undefined) {
    pause();
  }
});
document.addEventListener('keydown', (event) => {
  const key = visit === undefined || element('menu').open ? undefined : keyOf(event);
  if (key !== undefined) {
    visit.show.pressKey(key);
  }
});
canvas.addEventListener('webglcontextlost', () => stop(() => showProblem(new Error(sentence('drawing_lost')))));
element('without_camera').onclick = startWalk;
element('enter_room').onclick = enterRoom;
element('open_menu').onclick = openMenu;
element('close_menu').onclick = closeMenu;
element('language').onchange = ({target}) => {
  change({captions: target.value});
  showTitle();
};
let roomIsPossible = false;
canShowRoom().then((possible) => {
  roomIsPossible = possible;
});
writeTexts();
applyChoices();
showTitle();
openFolder().then(() => {
  if (go.onclick === start && !go.hidden && visit === undefined) {
    showTitle();
  }
}, () => {});  // Starting says what is wrong.
// The programs arrive while visitors read the title.
fetchPrograms().catch(() => {});
