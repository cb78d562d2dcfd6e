uniform float width_px;

in vec4 line_colour;
in float offset_px;

layout(location = 0) out vec4 colour;

void main() {
  float cover = clamp(0.5 * width_px + 0.5 - abs(offset_px), 0.0, 1.0);
  colour = vec4(line_colour.rgb, line_colour.a * cover);
}
