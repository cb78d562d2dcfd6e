// The camera of the device, and the images of its video as pixels.

// An error whose message is for visitors: what has happened, and what they can do.
export class Problem extends Error {}

const PROBLEMS = {
  NotAllowedError: 'The camera is not allowed for this page. Allow it in the browser, at the address of the page or in its settings, then try again.',
  NotFoundError: 'This device has no camera that a page can use. Open the page on a phone or a tablet.',
  NotReadableError: 'Another program or another tab uses the camera. Close it there, then try again.',
};

export async function openCamera() {
  if (navigator.mediaDevices === undefined) {
    throw new Problem('A page gets the camera from a secure address only. Open the address that begins with https.');
  }
  try {
    return await navigator.mediaDevices.getUserMedia({video: {
      facingMode: {ideal: 'environment'}, width: {ideal: 1280}, height: {ideal: 960}, frameRate: {ideal: 30}}});
  } catch (error) {
    throw new Problem(PROBLEMS[error.name] ?? `The camera does not start (${error.name}). Try again, or start the device again.`);
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
