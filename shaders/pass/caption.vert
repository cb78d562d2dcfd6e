// Rectangles of captions, in pixels of the target, whose first row is the top one.

uniform vec2 size_px;

layout(location = 0) in vec2 place;
layout(location = 1) in vec2 coordinate;
layout(location = 2) in vec4 colour;
layout(location = 3) in vec2 extent;

out vec2 at;
out vec4 paint;
out vec2 half_px;

void main() {
  at = coordinate;
  paint = colour;
  half_px = extent;
  gl_Position = vec4(place / size_px * 2.0 - 1.0, 0.0, 1.0);
}
