// Linear light to sRGB; what is brighter than white is clipped. The picture is
// stored with its top row first.

#include "colour.glsl"

uniform sampler2D linear_image;

layout(location = 0) out vec4 colour;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  pixel.y = textureSize(linear_image, 0).y - 1 - pixel.y;
  vec3 light = texelFetch(linear_image, pixel, 0).rgb;
  colour = vec4(SrgbFromLinear(clamp(light, 0.0, 1.0)), 1.0);
}
