uniform mat4 clip_from_stage;
uniform float size_px;

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;

out vec4 point_colour;

void main() {
  gl_Position = clip_from_stage * vec4(position, 1.0);
  gl_PointSize = size_px + 1.0;  // the rim fades over one pixel
  point_colour = colour;
}
