// Writes the factor on the light of real surfaces: shadows darken them, lamps brighten them. There
// is one value for every pixel or for every caught_step pixels.

#include "caught_shadow.glsl"

uniform sampler2D people;    // coverage in alpha
uniform vec4 people_bounds;  // left, bottom, right, top; no people outside
uniform int caught_step;     // width and height of one value, cells
uniform int hidden_margin;   // cells inside the edge of people that may be visible through it

layout(location = 0) out vec4 caught;

float Covered(ivec2 cell) {
  vec2 at = vec2(cell) + 0.5;
  bool within = all(greaterThan(at, people_bounds.xy)) && all(lessThan(at, people_bounds.zw));
  float covered = texelFetch(people, clamp(cell, ivec2(0), textureSize(people, 0) - 1), 0).a;
  return within ? covered : 0.0;
}

void main() {
  ivec2 cell = min(ivec2(gl_FragCoord.xy) * caught_step + caught_step / 2,
                   ivec2(catcher_bounds.zw) - 1);
  // Shadows behind people need not be computed.
  ivec2 aside = ivec2(hidden_margin, -hidden_margin);
  float covered = min(min(Covered(cell + aside.xx), Covered(cell + aside.yy)),
                      min(Covered(cell + aside.xy), Covered(cell + aside.yx)));
  int may_catch = min(covered, Covered(cell)) < 0.999 ? 1 : 0;
  vec3 kept = vec3(1.0);
  for (int i = 0; i < may_catch; ++i) {
    kept = CaughtShadow(cell);
  }
  caught = vec4(kept, 1.0);
}
