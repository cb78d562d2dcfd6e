// Captions and the guide's words before the eyes of a visitor with glasses, whose browser does not show the page's elements
// over the room.
import {sideOf} from './captions.js';
import {directionOf} from './texts.js';

// The panel stands upright before the head and moves with it: the place of its centre and its size, in metres.
const PANEL = {right: 0, up: -0.55, ahead: 1.8, width: 1.2, height: 0.6};
const PIXELS = [1024, 512];
// The height of letters in pixels, for each size that visitors can choose.
const LETTERS = [44, 60, 76];
const ROW = 1.3;               // The height of a row over that of its letters.

const VERTICES = `#version 300 es
uniform mat4 clip_from_panel;
out vec2 at;
void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = clip_from_panel * vec4(at.x - 0.5, 0.5 - at.y, 0.0, 1.0);
}`;
const FRAGMENTS = `#version 300 es
precision mediump float;
uniform sampler2D picture;
in vec2 at;
out vec4 colour;
void main() {
  colour = texture(picture, at);
}`;

function makeProgram(gl) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTICES], [gl.FRAGMENT_SHADER, FRAGMENTS]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader);
  }
  gl.linkProgram(program);
  return program;
}

// Breaks a text into rows that are no wider than `widest`.
function rowsOf(paint, text, widest) {
  const rows = [];
  for (const paragraph of text.split('\n')) {
    let row = '';
    for (const word of paragraph.split(' ')) {
      const longer = row === '' ? word : `${row} ${word}`;
      if (row !== '' && paint.measureText(longer).width > widest) {
        rows.push(row);
        row = word;
      } else {
        row = longer;
      }
    }
    rows.push(row);
  }
  return rows;
}

export class RoomTexts {
  // gl: a context of WebGL 2.
  constructor(gl) {
    this.gl = gl;
    this.program = makeProgram(gl);
    this.clipFromPanel = gl.getUniformLocation(this.program, 'clip_from_panel');
    this.vertices = gl.createVertexArray();
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    gl.bindTexture(gl.TEXTURE_2D, null);
    this.paint = new OffscreenCanvas(...PIXELS).getContext('2d');
    this.empty = true;
  }

  // Writes other texts onto the panel. texts: see PageShow::TakeTexts(). style: {size, contrast} of Choices.values.
  set({captions, hint}, language, {size, contrast}) {
    const {gl, paint} = this;
    const [width, height] = PIXELS;
    const letters = LETTERS[size];
    const texts = [...captions.map(({speaker, side, text}) => [sideOf(side), speaker, text].filter((part) => part).join(' ')), hint]
      .filter((text) => text !== '');
    this.empty = texts.length === 0;
    paint.clearRect(0, 0, width, height);
    paint.font = `${contrast > 0 ? 'bold ' : ''}${letters}px sans-serif`;
    Object.assign(paint, {textAlign: 'center', textBaseline: 'middle', direction: directionOf(language)});
    let bottom = height;
    for (const text of texts) {  // The latest caption is the lowest one.
      const rows = rowsOf(paint, text, width - letters);
      const widest = Math.max(...rows.map((row) => paint.measureText(row).width));
      const tall = rows.length * ROW * letters;
      paint.fillStyle = contrast > 0 ? '#000' : 'rgb(0 0 0 / 75%)';
      paint.fillRect((width - widest - letters) / 2, bottom - tall, widest + letters, tall);
      paint.fillStyle = '#fff';
      rows.forEach((row, i) => paint.fillText(row, width / 2, bottom - tall + (i + 0.5) * ROW * letters));
      bottom -= tall + letters / 4;
    }
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, true);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, paint.canvas);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.bindTexture(gl.TEXTURE_2D, null);
  }

  // Draws the panel over what views of WebXR show already. views: as for Show.drawInRoom(). viewer: the head's pose.
  draw(views, viewer, framebuffer) {
    if (this.empty) {
      return;
    }
    const {gl} = this;
    const panel = new DOMMatrix(viewer.matrix).translate(PANEL.right, PANEL.up, -PANEL.ahead).scale(PANEL.width, PANEL.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.useProgram(this.program);
    gl.bindVertexArray(this.vertices);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.disable(gl.SCISSOR_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    for (const {transform, projectionMatrix, viewport: {x, y, width, height}} of views) {
      const clip = new DOMMatrix(projectionMatrix).multiply(new DOMMatrix(transform.inverse.matrix)).multiply(panel);
      gl.uniformMatrix4fv(this.clipFromPanel, false, clip.toFloat32Array());
      gl.viewport(x, y, width, height);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }
    gl.disable(gl.BLEND);
    gl.bindTexture(gl.TEXTURE_2D, null);
    gl.bindVertexArray(null);
    gl.useProgram(null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }
}
