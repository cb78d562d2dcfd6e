// People in the room that the device itself shows and tracks (WebXR), in place of the camera's image.

import {RoomTexts} from './room_texts.js';

const IMAGE_SIDE = 640;          // The longer side of images for the tracker, in pixels.
const IMAGE_MILLISECONDS = 100;  // Milliseconds from one image for the tracker to the next.

// Asks whether the device can show people in the room.
export async function canShowRoom() {
  try {
    return await navigator.xr?.isSessionSupported('immersive-ar') ?? false;
  } catch {
    return false;
  }
}

let panel;  // The panel of texts in the page's context, which all its rooms share.

export class Room {
  // Called when the device or the visitor has ended the session.
  onend = () => {};

  // Asks the device to show the room, which browsers allow after a tap only. overlay: element to show over it.
  static async open(show, overlay) {
    const room = new Room();
    const session = await navigator.xr.requestSession('immersive-ar',
      {optionalFeatures: ['dom-overlay', 'camera-access'], domOverlay: {root: overlay}});
    try {
      const gl = show.context;
      await gl.makeXRCompatible();
      const layer = new XRWebGLLayer(session, gl, {antialias: false, depth: false, stencil: false});
      await session.updateRenderState({baseLayer: layer});
      const sees = session.enabledFeatures?.includes('camera-access') ?? false;
      const binding = sees ? new XRWebGLBinding(session, gl) : undefined;
      // Glasses seldom show elements of the page over the room.
      if (!session.domOverlayState?.type) {
        room.texts = panel ??= new RoomTexts(gl);
      }
      Object.assign(room, {session, gl, layer, binding, space: await session.requestReferenceSpace('local')});
    } catch (error) {
      await session.end();
      throw error;
    }
    session.onend = () => {
      room.session = undefined;
      room.onend();
    };
    return room;
  }

  // True if the device hands out images of its camera, so that the place can be found again and again.
  get sees() {
    return this.binding !== undefined;
  }

  // Calls draw(now, view) for the device's next frame. view: what Show.drawInRoom() draws and where the viewer is; undefined
  // while the device does not know that.
  awaitFrame(draw) {
    this.session?.requestAnimationFrame((now, frame) => {
      const pose = frame.getViewerPose(this.space);
      if (pose === null) {
        draw(now, undefined);
        return;
      }
      const views = pose.views.map((view) =>
        ({transform: view.transform, projectionMatrix: view.projectionMatrix, viewport: this.layer.getViewport(view)}))
        .filter(({viewport}) => viewport?.width > 0);
      this.camera = pose.views[0].camera;
      draw(now, {viewer: pose.transform, views, framebuffer: this.layer.framebuffer});
    });
  }

  // The camera's image of this frame, as show.js takes it; undefined while none is due.
  takeImage(now) {
    if (!this.sees || !this.camera || now - (this.taken ?? -Infinity) < IMAGE_MILLISECONDS) {
      return undefined;
    }
    this.taken = now;
    const {gl, camera} = this;
    const scale = Math.min(1, IMAGE_SIDE / Math.max(camera.width, camera.height));
    const [width, height] = [camera.width, camera.height].map((side) => 2 * Math.round(scale * side / 2));
    if (this.small?.width !== width || this.small?.height !== height) {
      this.small = {width, height, data: new Uint8Array(4 * width * height), texture: gl.createTexture(),
        from: gl.createFramebuffer(), to: gl.createFramebuffer()};
      gl.bindTexture(gl.TEXTURE_2D, this.small.texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, width, height);
      gl.bindTexture(gl.TEXTURE_2D, null);
    }
    const {data, texture, from, to} = this.small;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, from);
    gl.framebufferTexture2D(gl.READ_FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.binding.getCameraImage(camera), 0);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, to);
    gl.framebufferTexture2D(gl.DRAW_FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    // The device's images begin with their lowest row.
    gl.blitFramebuffer(0, 0, camera.width, camera.height, 0, height, width, 0, gl.COLOR_BUFFER_BIT, gl.LINEAR);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, to);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return {format: 'RGBA', width, height, data};
  }

  close() {
    this.onend = () => {};
    this.session?.end().catch(() => {});
  }
}
