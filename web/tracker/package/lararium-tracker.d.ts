/** A picture's luminance: one byte for each pixel, row by row, `stride` (default: width) bytes apart. */
export interface Luminance {
  data: Uint8Array;
  width: number;
  height: number;
  stride?: number;
}

/** A pinhole camera with OpenCV's distortion, in pixels; (0, 0) is the middle of the top left pixel. */
export interface Camera {
  width: number;
  height: number;
  fx: number;
  fy: number;
  cx: number;
  cy: number;
  k1?: number;
  k2?: number;
  p1?: number;
  p2?: number;
}

/**
 * Turns a point of the map into camera axes: x right, y down, z forward. Lengths are the map's own
 * unit; `map` is an index into the tracker's maps.
 */
export interface Pose {
  map: number;
  /** A unit quaternion: x, y, z, w. */
  rotation: [number, number, number, number];
  translation: [number, number, number];
}

/** All values of Tracked.state and Tracked.reason. */
export const STATES: readonly Tracked['state'][];
export const REASONS: readonly Tracked['reason'][];

export interface Tracked {
  state: 'searching' | 'tracking' | 'lost';
  /** Why the image has no pose. */
  reason: 'none' | 'too dark' | 'too few features' | 'too few matches' | 'no consistent pose' | 'ambiguous';
  /** Only while tracking. */
  pose: Pose | null;
  /** Whether the pose was tracked from the image before; otherwise it was found without a prior. */
  followed: boolean;
  /** Probability that the error in the picture is below one pixel. */
  confidence: number;
  inliers: number;
  /** The given camera, or what the tracker has found out of it. */
  camera: Required<Camera>;
}

/** What another worker is to find: structured-cloneable; its two buffers may be transferred. */
export interface Search {
  question: Float64Array;
  image: Luminance;
}

/** A real object that hides points of a map: triangles in the map's axes and unit, in either winding. */
export interface Occluder {
  /** Index into the tracker's maps; default: 0. */
  map?: number;
  /** x, y, z of each position. */
  positions: Float32Array;
  /** Three for each triangle. */
  indices: Uint32Array;
}

export class Tracker {
  /**
   * maps: the content of .larscene files. intrinsics: those of the images; without them the tracker
   * estimates the lens. postSearches: a second worker with a Searcher does the background's work; otherwise
   * track() does it, which takes long on one image of sixty. program: module.wasm, compiled; without it the
   * tracker fetches it.
   */
  static create(options: {
    maps: Uint8Array[]; intrinsics?: Camera; postSearches?: boolean; program?: WebAssembly.Module;
  }): Promise<Tracker>;
  /** Points behind it are not looked for, once images have confirmed it. Call it between two images. */
  addOccluder(occluder: Occluder): void;
  /**
   * Locates images of the maps, so that the browser has compiled the program for speed when the first image
   * comes; that takes about half a second. Poses do not depend on it.
   */
  warmUp(): void;
  /** seconds: time at which the image was taken, on any steady clock. */
  track(image: Luminance, seconds: number): Tracked;
  /** The map points that support the last pose: for each one its index in the map and its pixel (x, y). */
  seen(): Float64Array;
  /** Makes the next image be located without a prior. */
  relocalize(): void;
  /** After each track(): what is to be posted to the worker with the Searcher, or null. */
  takeSearch(): Search | null;
  giveAnswer(answer: Float64Array): void;
  close(): void;
}

export class Searcher {
  /** maps: the tracker's, in its order. program: as the tracker's. */
  static create(options: {maps: Uint8Array[]; program?: WebAssembly.Module}): Promise<Searcher>;
  /** Returns the answer for Tracker.giveAnswer(). */
  find(search: Search): Float64Array;
  close(): void;
}

/** The view matrix of a pose for WebGL, by columns: x right, y up, z backward. */
export function viewMatrix(pose: Pose): number[];
/** The projection matrix of a camera without its distortion for WebGL, by columns. */
export function projectionMatrix(camera: Camera, near: number, far: number): number[];
