// node room_test.mjs PAGE CHROMIUM WORK_FOLDER EDITOR PROJECT VIDEO IWER
// Shows people in the room of a device with WebXR, for which iwer stands: they are where the page's camera has seen them,
// and stay there when the device turns and moves. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {exportFolder, fileIn, serve, skipWithout} from './needs.mjs';
import {cameraOptions, press, PLAYS, READY, says, withBrowser, writeCamera} from './visitor.mjs';

const [page, program, work, editor, project, video, iwer] = process.argv.slice(2);
skipWithout(
  [`${page}/module.wasm`, 'build the preset `web`'], [editor, 'build lararium-editor'],
  [project, 'run the test acceptance/maquette'], [video, 'set LARARIUM_DATA_DIR'], [program, 'install chromium'],
  ['/usr/bin/ffmpeg', 'install ffmpeg'], [iwer, 'run scripts/fetch_iwer.sh']);
const DEGREE = Math.PI / 180;

mkdirSync(work, {recursive: true});
const camera = `${work}/camera.y4m`;
writeCamera(video, 640, 480, camera);
const folder = `${work}/folder`;
exportFolder(editor, project, page, folder);
const server = await serve((path) => fileIn(folder, path));

// Runs in the page: `seen` are the directions of people in the last picture, in radians to the right of and below straight
// ahead: in the camera's picture where it differs from the camera's image, in a room where anything is drawn.
function watch() {
  window.device = new IWER.XRDevice(IWER.metaQuest3);
  device.installRuntime({forceInstall: true});
  const pixels = (x, y, width, height) => {
    const gl = document.getElementById('lararium').getContext('webgl2');
    const data = new Uint8Array(4 * width * height);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
    gl.readPixels(x, y, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
    return data;
  };
  const directions = ({width, height, fx, fy, cx, cy}, isPerson) => {
    let [count, right, below] = [0, 0, 0];
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        if (isPerson(x, y)) {
          ++count;
          right += x;
          below += y;
        }
      }
    }
    return {count, share: count / (width * height), right: Math.atan((right / count - cx) / fx), below: Math.atan((below / count - cy) / fy)};
  };

  const Original = Worker;
  let image;
  window.Worker = class extends Original {
    constructor(...options) {
      super(...options);
      // The page's own listener comes first.
      setTimeout(() => this.addEventListener('message', ({data: {tracked}}) => {
        if (tracked?.pose && document.getElementById('card').hidden) {
          const {width, height} = image;
          const drawn = pixels(0, 0, width, height);
          window.seen = directions(tracked.camera, (x, y) => {
            const at = 4 * ((height - 1 - y) * width + x);
            const luminance = 0.299 * drawn[at] + 0.587 * drawn[at + 1] + 0.114 * drawn[at + 2];
            return Math.abs(luminance - (image.data[y * width + x] - 16) * 255 / 219) > 25;
          });
        }
      }));
    }
    postMessage(message, transfer) {
      if (message.image) {
        image = {...message.image, data: message.image.data.slice()};
      }
      super.postMessage(message, transfer);
    }
  };

  const request = XRSession.prototype.requestAnimationFrame;
  XRSession.prototype.requestAnimationFrame = function(draw) {
    return request.call(this, (now, frame) => {
      draw(now, frame);
      window.room = {session: this};
      const layer = this.renderState.baseLayer;
      const views = frame.getViewerPose(this.space)?.views ?? [];
      window.inRoom = views.map((view) => ({view, viewport: layer.getViewport(view)})).filter(({viewport}) => viewport.width > 0)
        .map(({view: {projectionMatrix: p}, viewport: {x, y, width, height}}) => {
          const drawn = pixels(x, y, width, height);
          return directions({width, height, fx: p[0] * width / 2, fy: p[5] * height / 2, cx: width / 2, cy: height / 2},
            (column, row) => {
              const at = 4 * ((height - 1 - row) * width + column);
              return drawn[at] + drawn[at + 1] + drawn[at + 2] > 60;
            });
        });
      window.pictures = (window.pictures ?? 0) + 1;
    });
  };
  const space = XRSession.prototype.requestReferenceSpace;
  XRSession.prototype.requestReferenceSpace = async function(type) {
    return this.space = await space.call(this, type);
  };
}

// Runs in the page: enters the room. `written` becomes what the room's panel shows first. Returns where people were seen, and
// the texts over the last picture.
async function enter() {
  const {RoomTexts} = await import('./room_texts.js');
  const {set} = RoomTexts.prototype;
  RoomTexts.prototype.set = function(texts, ...more) {
    window.written ??= [texts.captions.length, texts.hint];
    return set.call(this, texts, ...more);
  };
  document.getElementById('enter_room').click();
  return {seen, shown: [document.getElementById('captions').childElementCount, document.getElementById('hint').textContent]};
}

// Runs in the page: writes a caption for two eyes, 400 pixels wide and high, and tells where its letters are.
async function writeCaption() {
  const {RoomTexts} = await import('./room_texts.js');
  const gl = new OffscreenCanvas(800, 400).getContext('webgl2');
  const panel = new RoomTexts(gl);
  panel.set({captions: [{speaker: 'Vetutius', side: 0, text: 'Salvete'}], hint: ''}, 'la', {size: 0, contrast: 0});
  const projectionMatrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.02, 0];
  const poseAt = (x) => new XRRigidTransform({x, y: 0, z: 0, w: 1}, {x: 0, y: 0, z: 0, w: 1});
  const views = [-0.1, 0.1].map((x, i) =>
    ({transform: poseAt(x), projectionMatrix, viewport: {x: 400 * i, y: 0, width: 400, height: 400}}));
  panel.draw(views, poseAt(0), null);
  const eyes = views.map(({viewport: {x, y, width, height}}) => {
    const data = new Uint8Array(4 * width * height);
    gl.readPixels(x, y, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
    const white = Array.from({length: width * height}, (_, i) => i).filter((i) => data[4 * i] > 60);
    return {letters: white.length, lowest: white.every((i) => i < width * height / 2),
      x: white.reduce((sum, i) => sum + i % width, 0) / white.length};
  });
  return [room.session.domOverlayState?.type === undefined, ...eyes];
}

function check(good, text) {
  console.log(`${good ? 'ok  ' : 'MISS'} ${text}`);
  assert.ok(good, text);
}

const degrees = (angle) => (angle / DEGREE).toFixed(1);

// Returns the directions of people in a picture that the device draws after a change of its pose.
async function after(browser, change) {
  const before = await browser.evaluate(`(${change}, window.pictures ?? 0)`);
  await browser.until(`window.pictures >= ${before} + 2 && inRoom[0]?.count > 0`);
  return browser.evaluate('inRoom');
}

async function visit(browser) {
  await browser.open(`${server.origin}/`, `${readFileSync(iwer, 'utf8')}\n(${watch})()`);
  await browser.until(READY);
  await browser.setCamera(server.origin, 'granted');
  await press(browser);
  await browser.until(`document.getElementById('lararium').dataset.shows === 'show'`, 200);
  const ENTER = `document.getElementById('enter_room')`;
  await browser.until(`window.seen?.share > 0.02 && !${ENTER}.hidden && ${PLAYS}`, 200);
  const {seen: byCamera, shown} = await browser.evaluate(`(${enter})()`, true);

  const [first] = await after(browser, '0');
  writeFileSync(`${work}/room.png`, await browser.screenshot(844, 390));
  check(Math.abs(first.right - byCamera.right) < 3 * DEGREE && Math.abs(first.below - byCamera.below) < 4 * DEGREE,
    `in the room people stand ${degrees(first.right)} degrees to the right and ${degrees(first.below)} below, in the camera's ` +
    `picture ${degrees(byCamera.right)} and ${degrees(byCamera.below)}`);
  const [turned] = await after(browser, `device.quaternion.set(0, ${Math.sin(5 * DEGREE)}, 0, ${Math.cos(5 * DEGREE)})`);
  const moved = (turned.right - first.right) / DEGREE;
  check(Math.abs(moved - 10) < 1.5, `when the device turns by 10 degrees to the left, they move by ${moved.toFixed(1)} to the right`);
  const [far] = await after(browser, 'device.quaternion.set(0, 0, 0, 1), device.position.z += 1');
  check(far.share < 0.8 * first.share, `one metre back they cover ${(far.share / first.share).toFixed(2)} of the area`);
  const [left, right] = await after(browser, 'device.position.z -= 1, device.stereoEnabled = true');
  check(right !== undefined && left.right > right.right,
    `the left eye sees them ${degrees(left.right - right.right)} degrees more to the right than the right one`);

  const [texts, inLeft, inRight] = await browser.evaluate(`(${writeCaption})()`);
  check(inLeft.letters > 50 && inLeft.lowest && inRight.lowest && inLeft.x > inRight.x + 5,
    `a caption is written below the middle for both eyes, ${(inLeft.x - inRight.x).toFixed(1)} pixels further right for the left one`);
  assert.deepEqual(await browser.evaluate('written'), shown);
  console.log('ok   the panel begins with the texts that the page showed last');
  check(texts, 'the session has a panel for captions, because the emulator shows no elements over the room');

  await browser.evaluate('room.session.end()');
  await browser.until(says('The show waits for you'));
  await press(browser);
  await browser.evaluate('seen = undefined');
  await browser.until(`window.seen?.share > 0.02 && ${PLAYS}`, 200);
  console.log('ok   when the device leaves the room, the camera goes on');
}

try {
  await withBrowser(program, work, cameraOptions(camera), visit);
} finally {
  server.close();
}
