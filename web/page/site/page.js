// A visit: title, permission, show, and what stands in its way.
import {openCamera, Problem, readImage} from './camera.js';
import {Show} from './show.js';

const FRAME_SECONDS = 1 / 30;
const element = (id) => document.getElementById(id);
const [card, text, progress, go, video, canvas] = ['card', 'text', 'progress', 'go', 'video', 'lararium'].map(element);

// --- Screens

// Shows a sentence over the picture, and a button that goes on; without `act` there is no button.
function showCard(sentence, label, act) {
  text.textContent = sentence;
  card.hidden = false;
  progress.hidden = true;
  go.hidden = act === undefined;
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
    showCard(error.message, 'Try again', start);
  } else {
    console.error(error);
    showCard(`The show cannot go on: ${error.message}`, 'Load the page again', () => location.reload());
  }
}

// --- Loading

async function download(url) {
  const problem = new Problem('The show does not arrive. Look whether the device has a network, then try again.');
  try {
    const response = await fetch(url);
    if (!response.ok) {
      throw problem;
    }
    const size = Number(response.headers.get('content-length'));
    const parts = [];
    let received = 0;
    for (const reader = response.body.getReader(); ;) {
      const {done, value} = await reader.read();
      if (done) {
        break;
      }
      parts.push(value);
      received += value.length;
      showProgress(size > 0 ? received / size : 1);
    }
    return new Uint8Array(await new Blob(parts).arrayBuffer());
  } catch {
    throw problem;
  }
}

// The two workers, which follow the camera and search in the background.
class Place {
  constructor(maps) {
    const fail = ({message}) => this.onerror(new Error(message ?? 'a worker has ended'));
    const [tracker, searcher] = ['tracker_worker.js', 'search_worker.js'].map((file) => {
      const worker = new Worker(new URL(file, import.meta.url), {type: 'module'});
      worker.onerror = fail;
      return worker;
    });
    this.tracker = tracker;
    const {port1, port2} = new MessageChannel();
    searcher.postMessage({maps, port: port1}, [port1]);
    this.ready = new Promise((resolve, reject) => {
      this.onerror = reject;
      tracker.onmessage = ({data}) => {
        if (data.error !== undefined) {
          this.onerror(new Error(data.error));
        } else if (data.ready) {
          resolve();
        } else {
          this.ontracked(data);
        }
      };
    });
    tracker.postMessage({maps, search: port2}, [port2, ...maps.map((map) => map.buffer)]);
  }

  track(number, image, seconds) {
    this.tracker.postMessage({number, image, seconds}, [image.data.buffer]);
  }
}

async function load() {
  const show = await Show.open(await download('show.larshow'));
  const place = new Place(show.maps());
  showProgress(1);
  await new Promise((resolve) => setTimeout(resolve));  // The page is drawn before it is busy.
  show.load(matchMedia('(prefers-reduced-motion: reduce)').matches);
  await place.ready;
  place.ontracked = drawTracked;
  place.onerror = (error) => stop(() => showProblem(error));
  return {show, place};
}

let loading;
function loadOnce() {
  loading ??= load().catch((error) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

// --- Playing

// What plays now: show, place, and the camera's stream. undefined: nothing plays.
let visit;
// The image that is being tracked: {number, seconds, lateMs}.
let image = {number: 0};
// Seconds of the show's frames, which go on where they were when the camera starts again.
let seconds = 0;
// The callback that waits for the camera's next image.
let awaited = 0;

function awaitFrame() {
  awaited = video.requestVideoFrameCallback(trackFrame);
}

async function start() {
  showCard('The show is loading. Allow the camera when the browser asks.');
  let mine;
  try {
    const loaded = loadOnce();
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
    track.onended = track.onmute = () => stop(() => showCard(
      'The camera has stopped: its permission was taken back, or a call or another program uses it.', 'Try again', start));
    video.srcObject = stream;
    await video.play();
    navigator.wakeLock?.request('screen').catch(() => {});
    if (document.hidden) {
      pause();
    } else if (visit === mine) {
      card.hidden = true;
      awaitFrame();
    }
  } catch (error) {
    // If another visit plays or this one was stopped, a sentence says so already.
    if (mine === visit) {
      stop(() => showProblem(error));
    }
  }
}

// Lets the camera go, and shows what has happened.
function stop(show) {
  const stopped = visit;
  visit = undefined;
  video.cancelVideoFrameCallback(awaited);
  ++image.number;  // The answer to the image under way is ignored.
  if (stopped !== undefined) {
    stopped.stream.getVideoTracks().forEach((track) => {
      track.onended = track.onmute = null;
      track.stop();
    });
    video.srcObject = null;
  }
  show();
}

function pause() {
  stop(() => showCard('The show waits for you, and the camera is off.', 'Go on', start));
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

// Draws the very image that was tracked.
function drawTracked({number, tracked, seen}) {
  if (visit === undefined || number !== image.number) {
    return;
  }
  if (canvas.width !== image.width || canvas.height !== image.height) {
    Object.assign(canvas, {width: image.width, height: image.height});
  }
  try {
    visit.show.draw(tracked, seen, image.seconds, image.lateMs);
    awaitFrame();
  } catch (error) {
    stop(() => showProblem(error));
  }
}

document.addEventListener('visibilitychange', () => {
  if (document.hidden && visit !== undefined) {
    pause();
  }
});
canvas.addEventListener('webglcontextlost', () => stop(() => showProblem(new Error('the browser has taken its drawing back'))));
go.onclick = start;
