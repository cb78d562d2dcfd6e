uniform float size_px;

in vec4 point_colour;

layout(location = 0) out vec4 colour;

void main() {
  float distance_px = length(gl_PointCoord - 0.5) * (size_px + 1.0);
  float cover = clamp(0.5 * size_px + 0.5 - distance_px, 0.0, 1.0);
  if (cover == 0.0) {
    discard;
  }
  colour = vec4(point_colour.rgb, point_colour.a * cover);
}
