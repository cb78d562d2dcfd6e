// Draws a letter from an atlas of signed distances (Green, Improved Alpha-Tested Magnification for
// Vector Textures and Special Effects, SIGGRAPH courses 2007), antialiased over one pixel.

uniform sampler2D atlas;
uniform float range_px;  // pixels of the target between the atlas' values 0 and 1
uniform float bolder_px;

in vec2 at;
in vec4 paint;
in vec2 half_px;

layout(location = 0) out vec4 colour;

void main() {
  float inside_px = (texture(atlas, at).r - 0.5) * range_px + bolder_px;
  colour = vec4(paint.rgb, paint.a * clamp(inside_px + 0.5, 0.0, 1.0));
}
