// The camera of the device, and the images of its video as pixels.
import {sentence} from './texts.js';

// An error for visitors: what has happened, and what they can do.
export class Problem extends Error {
  // name: of a sentence in texts.js.
  constructor(name, detail = '') {
    super(`${sentence(name)}${detail}`);
  }
}

const PROBLEMS = {NotAllowedError: 'refused', NotFoundError: 'no_camera', NotReadableError: 'busy'};

export async function openCamera() {
  if (navigator.mediaDevices === undefined) {
    throw new Problem('insecure');
  }
  try {
    return await navigator.mediaDevices.getUserMedia({video: {
      facingMode: {ideal: 'environment'}, width: {ideal: 1280}, height: {ideal: 960}, frameRate: {ideal: 30}}});
  } catch (error) {
    const known = PROBLEMS[error.name];
    throw known === undefined ? new Problem('camera_fails', ` (${error.name})`) : new Problem(known);
  }
}

const LAYOUTS = {
  I420: (width, height) => [{offset: 0, stride: width}, {offset: width * height, stride: width / 2},
    {offset: width * height * 5 / 4, stride: width / 2}],
  NV12: (width, height) => [{offset: 0, stride: width}, {offset: width * height, stride: width}],
};

let canvas;

// The image that the video shows now, as show.js takes it.
export async function readImage(video) {
  const {videoWidth: width, videoHeight: height} = video;
  // The planes of a camera's image cost least. Where the browser would still have to turn or scale them, or
  // has none, a canvas does it.
  if (globalThis.VideoFrame !== undefined && width % 2 === 0 && height % 2 === 0) {
    const frame = new VideoFrame(video);
    try {
      const {format, visibleRect} = frame;
      if (LAYOUTS[format] && visibleRect.width === width && visibleRect.height === height && !frame.rotation && !frame.flip) {
        const data = new Uint8Array(width * height * 3 / 2);
        await frame.copyTo(data, {layout: LAYOUTS[format](width, height)});
        return {format, width, height, data};
      }
    } finally {
      frame.close();
    }
  }
  canvas ??= document.createElement('canvas');
  if (canvas.width !== width || canvas.height !== height) {
    Object.assign(canvas, {width, height});
  }
  const context = canvas.getContext('2d', {willReadFrequently: true});
  context.drawImage(video, 0, 0, width, height);
  return {format: 'RGBA', width, height, data: context.getImageData(0, 0, width, height).data};
}
