// A rectangle with round corners.

#include "stripes.glsl"

uniform float radius_px;
uniform int stripes;
uniform float stripe_px;

in vec2 at;  // pixels from the middle
in vec4 paint;
in vec2 half_px;

layout(location = 0) out vec4 colour;

void main() {
  vec2 beyond = abs(at) - half_px + radius_px;
  float away = length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0) - radius_px;
  vec3 striped = mix(paint.rgb, vec3(1.0), 0.6 * Stripes(stripes, stripe_px));
  colour = vec4(striped, paint.a * clamp(0.5 - away, 0.0, 1.0));
}
