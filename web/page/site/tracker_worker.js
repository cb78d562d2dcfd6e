// Follows the camera. Takes {maps, program, search} first, where search is the port to search_worker.js, and says {ready}; then
// takes {number, image, seconds} and says {number, tracked, seen}. {relocalize} makes it find the place again without what
// it knows; {occluders} hide points of the maps from then on. Says {error} if something fails.
import {Tracker} from './lararium-tracker/lararium-tracker.js';

let maps;
let program;
let search;
let occluders = [];
let tracker;
let size = '';
let generation = 0;

async function create() {
  tracker?.close();
  tracker = await Tracker.create({maps, program, postSearches: true});
  occluders.forEach((occluder) => tracker.addOccluder(occluder));
  ++generation;
}

async function obey(message) {
  if (message.maps) {
    ({maps, program, search} = message);
    await create();
    tracker.warmUp();
    search.onmessage = ({data: {asked, answer, error}}) => {
      if (error !== undefined) {
        postMessage({error});
      } else if (asked === generation) {
        tracker.giveAnswer(answer);
      }
    };
    return {ready: true};
  }
  if (message.occluders) {
    ({occluders} = message);
    occluders.forEach((occluder) => tracker.addOccluder(occluder));
    return {};
  }
  if (message.relocalize) {
    tracker.relocalize();
    return {};
  }
  const {number, image, seconds} = message;
  const now = `${image.width}x${image.height}`;
  if (size !== '' && size !== now) {  // The device was turned.
    await create();
  }
  size = now;
  const tracked = tracker.track(image, seconds);
  const question = tracker.takeSearch();
  if (question !== null) {
    search.postMessage({asked: generation, question}, [question.image.data.buffer]);
  }
  return {number, tracked, seen: tracker.seen()};
}

// One message after another, because a new tracker takes a moment.
let obeyed = Promise.resolve();
onmessage = ({data}) => {
  obeyed = obeyed.then(() => obey(data)).catch((error) => ({error: error.message})).then(
    (answer) => postMessage(answer, answer.seen ? [answer.seen.buffer] : []));
};
