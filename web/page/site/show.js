// The show as a program with memory of its own. It draws into the canvas with the id "lararium".
import {REASONS, STATES} from './lararium-tracker/lararium-tracker.js';
import createModule from './module.mjs';

const FORMATS = ['I420', 'NV12', 'RGBA'];
const FILE = '/show.larshow';

function hourNow() {
  const now = new Date();
  return now.getHours() + now.getMinutes() / 60;
}

export class Show {
  time = 0;

  // bundle: the bytes of a .larshow file, which must not be used any more.
  static async open(bundle) {
    const show = new Show();
    show.module = await createModule();
    show.module.FS.writeFile(FILE, bundle, {canOwn: true});
    show.numbers = show.module._malloc(21 * 8);  // The program reads PageShow::kTrackedNumbers of them.
    show.check(show.module._lararium_open());
    show.module.FS.unlink(FILE);  // The program has its own copy.
    return show;
  }

  check(error) {
    if (error !== 0) {
      throw new Error(this.module.UTF8ToString(error));
    }
  }

  // Copies of the maps of its places, for the tracker.
  maps() {
    return Array.from({length: this.module._lararium_map_count()}, (_, i) => {
      this.check(this.module._lararium_map(i, this.numbers));
      const [at, size] = this.module.HEAPU32.subarray(this.numbers / 4, this.numbers / 4 + 2);
      return this.module.HEAPU8.slice(at, at + size);
    });
  }

  // languages: {spoken, captions}; '' is the author's choice.
  load(languages) {
    this.callWithLanguages('lararium_load', languages);
    this.length = this.module._lararium_length();  // Seconds; 0: not known.
  }

  // Goes on in other languages. Sound must be opened again.
  setLanguages(languages) {
    this.callWithLanguages('lararium_set_languages', languages);
  }

  callWithLanguages(name, {spoken, captions}) {
    this.check(this.module.ccall(name, 'number', ['string', 'string'], [spoken, captions]));
    this.language = this.module.UTF8ToString(this.module._lararium_language());
  }

  // out: node of Web Audio that takes the show's sound.
  openSound(out) {
    this.module.audioOut = out;
    this.check(this.module._lararium_open_sound());
  }

  choose({descriptions, reducedMotion}) {
    this.module._lararium_choose(descriptions, reducedMotion);
  }

  restart() {
    this.module._lararium_restart();
    this.time = 0;
  }

  forgetPose() {
    this.module._lararium_forget_pose();
  }

  // Takes an image of readImage(), and returns its luminance for the tracker.
  setImage({format, width, height, data}) {
    this.module.HEAPU8.set(data, this.module._lararium_new_image(FORMATS.indexOf(format), width, height));
    const at = this.module._lararium_luminance();
    return {data: this.module.HEAPU8.slice(at, at + width * height), width, height};
  }

  // Draws the image that was set last. tracked, seen: what Tracker.track() and seen() said about it.
  // shown: visibility of people, 0 to 1.
  draw(tracked, seen, seconds, lateMs, shown) {
    const {width, height, fx, fy, cx, cy, k1, k2, p1, p2} = tracked.camera;
    const {map, rotation, translation} = tracked.pose ?? {map: 0, rotation: [0, 0, 0, 1], translation: [0, 0, 0]};
    this.module.HEAPF64.set([STATES.indexOf(tracked.state), REASONS.indexOf(tracked.reason), Number(tracked.followed), map,
      ...rotation, ...translation, width, height, fx, fy, cx, cy, k1, k2, p1, p2], this.numbers / 8);
    this.module.HEAPF64.set(seen, this.module._lararium_new_seen(seen.length / 3) / 8);
    this.check(this.module._lararium_draw(this.numbers, seconds, hourNow(), lateMs, shown));
    this.time = this.module._lararium_time();  // Of the drama, seconds.
  }

  // Draws a keyframe of the map, which needs no camera (PageShow::DrawView()).
  drawView(index, seconds, lateMs, shown) {
    this.check(this.module._lararium_draw_view(index, seconds, hourNow(), lateMs, shown));
    this.time = this.module._lararium_time();
  }

  get viewCount() {
    return this.module._lararium_view_count();
  }

  viewSize(index) {
    this.module._lararium_view_size(index, this.numbers);
    const [width, height] = this.module.HEAPU32.subarray(this.numbers / 4, this.numbers / 4 + 2);
    return {width, height};
  }

  // The texts over the picture (PageShow::TakeTexts()); undefined if they have not changed.
  takeTexts() {
    const at = this.module._lararium_texts();
    return at === 0 ? undefined : JSON.parse(this.module.UTF8ToString(at));
  }
}
