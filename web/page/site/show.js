// The show as a program with memory of its own. It draws into the canvas with the id "lararium".
import {REASONS, STATES} from './lararium-tracker/lararium-tracker.js';
import createModule from './module.mjs';

const FORMATS = ['I420', 'NV12', 'RGBA'];

// What begins with members that have arrived (PageShow::Stage).
export const [GUIDE, DRAMA, PERSON, THINGS, VOICES, SHOW, LANGUAGES] = [0, 1, 2, 3, 4, 5, 6];

// The wishes of the staff for a group's drama (GroupWish::What).
export const WISHES = ['hold', 'resume', 'go_to', 'restart'];

function hourNow() {
  const now = new Date();
  return now.getHours() + now.getMinutes() / 60;
}

const MOST_VIEWS = 8;  // Devices have fewer views of a room.

const poseNumbers = ({position, orientation}) =>
  [position.x, position.y, position.z, orientation.x, orientation.y, orientation.z, orientation.w];

export class Show {
  time = 0;

  // Verifies the manifest of a folder. program: module.wasm, compiled.
  static async open({text, signature, key}, program) {
    const show = new Show();
    show.module = await createModule({
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(program, imports).then(done);
        return {};
      },
    });
    show.numbers = show.module._malloc(21 * 8);  // The program reads PageShow::kTrackedNumbers of them.
    show.roomNumbers = show.module._malloc(MOST_VIEWS * 27 * 8);  // The program reads RoomView::kNumbers for each view.
    show.call('lararium_open', text, signature, key);
    return show;
  }

  // Calls a function that can fail with texts, numbers, and arrays of bytes with their sizes.
  call(name, ...values) {
    const all = values.flatMap((value) => value instanceof Uint8Array ? [value, value.length] : [value]);
    const types = all.map((value) => value instanceof Uint8Array ? 'array' : typeof value);
    this.check(this.module.ccall(name, 'number', types, all));
  }

  names() {
    return this.module.UTF8ToString(this.module._lararium_names()).split('\n').slice(0, -1);
  }

  // The names of the members that a stage needs and that have not arrived. languages: see load().
  findMissing(stage, {spoken, captions, read}) {
    this.call('lararium_find_missing', stage, spoken, captions, read);
    return this.names();
  }

  // Verifies the manifest of another version, and returns the names of all members that it needs.
  findNeeded({text, signature, key}, {spoken, captions, read}) {
    this.call('lararium_find_needed', text, signature, key, spoken, captions, read);
    return this.names();
  }

  // Verifies a member and keeps it.
  addPiece(name, bytes) {
    const at = this.module._lararium_new_piece(bytes.length);  // HEAPU8 may be another one afterwards.
    this.module.HEAPU8.set(bytes, at);
    this.call('lararium_add_piece', name);
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

  // Copies of the occluders of its places, for the tracker, after load(DRAMA) or load(SHOW).
  occluders() {
    return Array.from({length: this.module._lararium_map_count()}, (_, map) =>
      Array.from({length: this.module._lararium_find_occluders(map)}, (_, i) => {
        this.module._lararium_occluder(i, this.numbers);
        const [positions, positionCount, indices, indexCount] = this.module.HEAPU32.subarray(this.numbers / 4, this.numbers / 4 + 4);
        return {map, positions: this.module.HEAPF32.slice(positions / 4, positions / 4 + 3 * positionCount),
          indices: this.module.HEAPU32.slice(indices / 4, indices / 4 + indexCount)};
      })).flat();
  }

  // Begins the guide or the show with what has arrived. languages: {spoken, captions, read}; '' is the author's choice.
  // captions: OFF for none; then the guide's words and descriptions are in the language `read`.
  load(stage, languages) {
    this.callWithLanguages(stage === GUIDE ? 'lararium_load_guide' : 'lararium_load', languages);
    this.length = this.module._lararium_length();  // Seconds; 0: not known.
  }

  // Lets people appear who have arrived since load().
  loadPeople() {
    this.check(this.module._lararium_load_people());
  }

  // Lets all things appear, which have arrived since load().
  loadThings() {
    this.check(this.module._lararium_load_things());
  }

  // Takes the voices that have arrived since load(). Sound must be opened again.
  loadVoices(languages) {
    this.callWithLanguages('lararium_load_voices', languages);
  }

  // Goes on in other languages. Sound must be opened again.
  setLanguages(languages) {
    this.callWithLanguages('lararium_set_languages', languages);
  }

  callWithLanguages(name, {spoken, captions, read}) {
    this.call(name, spoken, captions, read);
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

  // A key for the drama, by its name (keys.js).
  pressKey(key) {
    this.module.ccall('lararium_press_key', null, ['string'], [key]);
  }

  restart() {
    this.hold(false);
    this.module._lararium_restart();
    this.time = 0;
  }

  // Plays the drama of the folder's group from load() on. Returns whether there is one. name: of this page.
  joinGroup(name) {
    const boot = crypto.getRandomValues(new Uint32Array(2));
    return this.module.ccall('lararium_join_group', 'boolean', ['string', 'number', 'number'], [name, ...boot]);
  }

  // A message of another member.
  takeMessage(from, bytes) {
    this.module.ccall('lararium_take_message', null, ['string', 'array', 'number'], [from, bytes, bytes.length]);
  }

  setGone(name) {
    this.module.ccall('lararium_set_gone', null, ['string'], [name]);
  }

  // what: one of WISHES. toAll: all members have got it.
  want(what, marker, toAll) {
    this.module.ccall('lararium_want', null, ['number', 'string', 'boolean'], [WISHES.indexOf(what), marker, toAll]);
  }

  // Does what is due in the group. Returns the messages to be sent: {to, bytes, reliable}; to: '' stands for all members.
  stepGroup() {
    return Array.from({length: this.module._lararium_step_group()}, (_, i) => {
      const to = this.module.UTF8ToString(this.module._lararium_outgoing(i, this.numbers));
      const [at, size, reliable] = this.module.HEAPU32.subarray(this.numbers / 4, this.numbers / 4 + 3);
      return {to, bytes: this.module.HEAPU8.slice(at, at + size), reliable: reliable !== 0};
    });
  }

  // The field `drama` of a device's state.
  groupState() {
    return JSON.parse(this.module.UTF8ToString(this.module._lararium_group_state()));
  }

  // The staff holds the drama, or goes to one of its markers.
  hold(holds) {
    this.module._lararium_hold(holds);
  }

  goTo(marker) {
    this.module.ccall('lararium_go_to', null, ['string'], [marker]);
  }

  // Describes the show to a fleet (PageShow::DescribeState()).
  state() {
    return {...JSON.parse(this.module.UTF8ToString(this.module._lararium_state())), memory_mib: this.module.HEAPU8.length / 2 ** 20};
  }

  forgetPose() {
    this.module._lararium_forget_pose();
  }

  // Takes an image of readImage(), and returns its luminance for the tracker.
  setImage({format, width, height, data}) {
    const pixels = this.module._lararium_new_image(FORMATS.indexOf(format), width, height);
    this.module.HEAPU8.set(data, pixels);
    const at = this.module._lararium_luminance();
    return {data: this.module.HEAPU8.slice(at, at + width * height), width, height};
  }

  // Writes what Tracker.track() said, as the program reads it at this.numbers.
  writeTracked(tracked) {
    const {width, height, fx, fy, cx, cy, k1, k2, p1, p2} = tracked.camera;
    const {map, rotation, translation} = tracked.pose ?? {map: 0, rotation: [0, 0, 0, 1], translation: [0, 0, 0]};
    this.module.HEAPF64.set([STATES.indexOf(tracked.state), REASONS.indexOf(tracked.reason), Number(tracked.followed), map,
      ...rotation, ...translation, width, height, fx, fy, cx, cy, k1, k2, p1, p2], this.numbers / 8);
  }

  // Draws the image that was set last. tracked, seen: what Tracker.track() and seen() said about it.
  // shown: visibility of people, 0 to 1.
  draw(tracked, seen, seconds, lateMs, shown) {
    this.writeTracked(tracked);
    const points = this.module._lararium_new_seen(seen.length / 3);
    this.module.HEAPF64.set(seen, points / 8);
    this.check(this.module._lararium_draw(this.numbers, seconds, hourNow(), lateMs, shown));
    this.time = this.module._lararium_time();  // Seconds of the drama.
  }

  // Draws a keyframe of the map, which needs no camera (PageShow::DrawView()).
  drawView(index, seconds, lateMs, shown) {
    this.check(this.module._lararium_draw_view(index, seconds, hourNow(), lateMs, shown));
    this.time = this.module._lararium_time();
  }

  // Lets people be drawn in a room that the device tracks (PageShow::EnterRoom()). sees: whether findStage() will
  // be called with images of the device's camera.
  enterRoom(sees) {
    this.module._lararium_enter_room(sees);
  }

  // Measures where the stage is. tracked: an image's, taken at the viewer's pose {position, orientation} of WebXR.
  findStage(tracked, viewer, seconds) {
    this.writeTracked(tracked);
    this.module.HEAPF64.set(poseNumbers(viewer), this.roomNumbers / 8);
    this.module._lararium_find_stage(this.numbers, this.roomNumbers, seconds);
  }

  // Draws people for views {transform, projectionMatrix, viewport} of WebXR into a framebuffer.
  drawInRoom(views, framebuffer, seconds, lateMs, shown) {
    const numbers = views.flatMap(({transform, projectionMatrix, viewport: {x, y, width, height}}) =>
      [...poseNumbers(transform), ...projectionMatrix, x, y, width, height]);
    this.module.HEAPF64.set(numbers, this.roomNumbers / 8);
    this.check(this.module._lararium_draw_in_room(
      this.roomNumbers, views.length, this.nameFramebuffer(framebuffer), seconds, hourNow(), lateMs, shown));
    this.time = this.module._lararium_time();
  }

  // The context in which the show is drawn.
  get context() {
    return this.module.GL.currentContext.GLctx;
  }

  // The program's number for a framebuffer that a session of WebXR has made; 0 for the canvas.
  nameFramebuffer(framebuffer) {
    if (framebuffer !== null && framebuffer.name === undefined) {
      const {GL} = this.module;
      framebuffer.name = GL.getNewId(GL.framebuffers);
      GL.framebuffers[framebuffer.name] = framebuffer;
    }
    return framebuffer?.name ?? 0;
  }

  // The luminance of the keyframe that drawView() shows, row by row.
  viewPicture(index) {
    const {width, height} = this.viewSize(index);
    const at = this.module._lararium_view_picture(index);
    return this.module.HEAPU8.slice(at, at + width * height);
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
