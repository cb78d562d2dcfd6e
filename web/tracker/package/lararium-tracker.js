// Finds the pose of a camera in a place that Lararium's editor was trained on.
import createModule from './module.mjs';

// In the order of the program's numbers.
export const STATES = ['searching', 'tracking', 'lost'];
export const REASONS = ['none', 'too dark', 'too few features', 'too few matches', 'no consistent pose', 'ambiguous'];

// The program's bytes or their compilation; one for all trackers of a worker.
let compiled;
function compile() {
  const url = new URL('./module.wasm', import.meta.url);
  compiled ??= url.protocol === 'file:'
    ? import('node:fs/promises').then((fs) => fs.readFile(url)).then((bytes) => WebAssembly.compile(bytes))
    : WebAssembly.compileStreaming(fetch(url));
  return compiled;
}

async function instantiate(program) {
  program ??= await compile();
  return createModule({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(program, imports).then(done);
      return {};
    },
  });
}

// What Tracker and Searcher share: a session of the program, with memory of its own.
class Session {
  static async open(maps, posted, program) {
    const session = new this();
    session.module = await instantiate(program);
    session.handle = session.module._lararium_open(posted);
    for (const map of maps) {
      session.withCopy(map, (at) => session.check(session.module._lararium_add_map(session.handle, at, map.byteLength)));
    }
    return session;
  }

  close() {
    this.module._lararium_close(this.handle);
    this.module = undefined;
  }

  check(error) {
    if (error !== 0) {
      throw new Error(this.module.UTF8ToString(error));
    }
  }

  // Calls use(address) with a copy of an array of bytes or doubles, which is freed afterwards.
  withCopy(array, use) {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    const at = this.module._malloc(Math.max(bytes.length, 1));
    try {
      this.module.HEAPU8.set(bytes, at);
      return use(at);
    } finally {
      this.module._free(at);
    }
  }

  doubles(at, count) {
    return this.module.HEAPF64.slice(at / 8, at / 8 + count);
  }

  setImage({data, width, height, stride = width}) {
    if (!(width > 0 && height > 0 && data.length >= stride * (height - 1) + width)) {
      throw new RangeError(`an image of ${width}x${height} pixels needs as many bytes; it has ${data.length}`);
    }
    const at = this.module._lararium_new_image(this.handle, width, height);
    for (let row = 0; row < height; ++row) {
      this.module.HEAPU8.set(data.subarray(row * stride, row * stride + width), at + row * width);
    }
  }
}

export class Tracker extends Session {
  static async create({maps, intrinsics, postSearches = false, program}) {
    const tracker = await Tracker.open(maps, postSearches, program);
    if (intrinsics !== undefined) {
      const {width, height, fx, fy, cx, cy, k1 = 0, k2 = 0, p1 = 0, p2 = 0} = intrinsics;
      tracker.withCopy(Float64Array.of(fx, fy, cx, cy, k1, k2, p1, p2), (at) => tracker.check(
        tracker.module._lararium_set_intrinsics(tracker.handle, at, 8, width, height)));
    }
    return tracker;
  }

  addOccluder({map = 0, positions, indices}) {
    this.withCopy(positions, (from) => this.withCopy(indices, (at) => this.check(this.module._lararium_add_occluder(
      this.handle, map, from, positions.length / 3, at, indices.length))));
  }

  warmUp() {
    this.check(this.module._lararium_warm_up(this.handle));
  }

  track(image, seconds) {
    this.setImage(image);
    this.check(this.module._lararium_track(this.handle, seconds));
    const [state, reason, followed, map, confidence, inliers, qx, qy, qz, qw, tx, ty, tz,
      width, height, fx, fy, cx, cy, k1, k2, p1, p2] =
      this.doubles(this.module._lararium_tracked(this.handle), 23);
    const tracking = STATES[state] === 'tracking';
    return {
      state: STATES[state],
      reason: REASONS[reason],
      pose: tracking ? {map, rotation: [qx, qy, qz, qw], translation: [tx, ty, tz]} : null,
      followed: followed !== 0,
      confidence,
      inliers,
      camera: {width, height, fx, fy, cx, cy, k1, k2, p1, p2},
    };
  }

  seen() {
    return this.withCopy(new Float64Array(1), (count) => {
      const at = this.module._lararium_seen(this.handle, count);
      return this.doubles(at, this.module.HEAPU32[count / 4]);
    });
  }

  relocalize() {
    this.module._lararium_relocalize(this.handle);
  }

  takeSearch() {
    const count = this.module._lararium_question_size(this.handle);
    if (count === 0) {
      return null;
    }
    const question = this.doubles(this.module._lararium_question(this.handle), count);
    const [width, height] = question.subarray(1, 3);
    const at = this.module._lararium_question_image(this.handle);
    const data = this.module.HEAPU8.slice(at, at + width * height);
    this.module._lararium_posted(this.handle);
    return {question, image: {data, width, height}};
  }

  giveAnswer(answer) {
    this.withCopy(answer, (at) => this.check(this.module._lararium_answer(this.handle, at, answer.length)));
  }
}

export class Searcher extends Session {
  static create({maps, program}) {
    return Searcher.open(maps, false, program);
  }

  find({question, image}) {
    this.setImage(image);
    this.withCopy(question, (at) => this.check(this.module._lararium_find(this.handle, at, question.length)));
    return this.doubles(this.module._lararium_found(this.handle), this.module._lararium_found_size(this.handle));
  }
}

export function viewMatrix({rotation: [x, y, z, w], translation: [tx, ty, tz]}) {
  return [
    1 - 2 * (y * y + z * z), -2 * (x * y + w * z), -2 * (x * z - w * y), 0,
    2 * (x * y - w * z), -(1 - 2 * (x * x + z * z)), -2 * (y * z + w * x), 0,
    2 * (x * z + w * y), -2 * (y * z - w * x), -(1 - 2 * (x * x + y * y)), 0,
    tx, -ty, -tz, 1];
}

export function projectionMatrix({width, height, fx, fy, cx, cy}, near, far) {
  return [
    2 * fx / width, 0, 0, 0,
    0, 2 * fy / height, 0, 0,
    1 - 2 * (cx + 0.5) / width, 2 * (cy + 0.5) / height - 1, (near + far) / (near - far), -1,
    0, 0, 2 * near * far / (near - far), 0];
}
