// Real walls that block the light of lamps (shared/light/lamp_walls.h).

#include "octahedral.glsl"

uniform highp sampler3D lamp_walls;  // planes, one layer for each lamp
uniform int lamps_with_walls;        // bit i: lamp i has walls

// A point farther behind a plane than this, in metres, is in its shadow (LampWalls::kOnWall).
const float kOnWall = 0.03;

float PastWall(ivec3 texel, vec3 point) {
  vec4 plane = texelFetch(lamp_walls, texel, 0);
  return dot(plane.xyz, point) - plane.w > kOnWall ? 0.0 : 1.0;
}

// The share of a lamp's light that passes the walls and reaches a point. way: direction from lamp
// to point.
float PastWalls(int lamp, vec3 way, vec3 point) {
  float seen = 1.0;
  for (int i = 0; i < (lamps_with_walls >> lamp & 1); ++i) {
    float last = float(textureSize(lamp_walls, 0).x - 1);
    vec2 at = OctahedralPosition(way) * last;
    vec2 low = clamp(floor(at), vec2(0.0), vec2(last - 1.0));
    vec2 part = at - low;
    ivec3 texel = ivec3(ivec2(low), lamp);
    seen = mix(mix(PastWall(texel, point), PastWall(texel + ivec3(1, 0, 0), point), part.x),
               mix(PastWall(texel + ivec3(0, 1, 0), point),
                   PastWall(texel + ivec3(1, 1, 0), point), part.x),
               part.y);
  }
  return seen;
}
