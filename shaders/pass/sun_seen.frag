// How much of the sun the nearest people and props see, pixel by pixel. Apart from their own
// shader, because many small triangles share a pixel there.

#include "picture_rays.glsl"
#include "sun.glsl"

uniform sampler2D nearest_depth;
uniform ivec2 last_cell;

layout(location = 0) out vec4 seen;

float DepthAt(ivec2 cell) {
  return texelFetch(nearest_depth, clamp(cell, ivec2(0), last_cell), 0).r;
}

// How the surface goes on from one pixel to the next, on the side that is more likely to be
// of the same one.
vec3 Tangent(ivec2 cell, ivec2 step, vec3 point, float depth, float before, float after) {
  before = DepthInMetres(before);
  after = DepthInMetres(after);
  return abs(after - depth) < abs(before - depth) ? SurfacePoint(cell + step, after) - point
                                                  : point - SurfacePoint(cell - step, before);
}

void main() {
  const ivec2 kRight = ivec2(1, 0);
  const ivec2 kUp = ivec2(0, 1);
  ivec2 cell = ivec2(gl_FragCoord.xy);
  float buffered = DepthAt(cell);
  vec4 sides =
      vec4(DepthAt(cell - kRight), DepthAt(cell + kRight), DepthAt(cell - kUp), DepthAt(cell + kUp));
  // Nobody there, but at the side: the pixel may be part of an edge.
  vec2 nearer = min(sides.xy, sides.zw);
  buffered = buffered < 1.0 ? buffered : min(nearer.x, nearer.y);
  float depth = DepthInMetres(buffered);
  vec3 point = SurfacePoint(cell, depth);
  vec3 normal = cross(Tangent(cell, kRight, point, depth, sides.x, sides.y),
                      Tangent(cell, kUp, point, depth, sides.z, sides.w));
  normal *= inversesqrt(max(dot(normal, normal), 1e-20));
  normal = dot(normal, eye_in_stage - point) < 0.0 ? -normal : normal;
  // Facets turn away a little sooner than the smooth surface that they stand for.
  int asked = buffered < 1.0 && dot(normal, sun_direction) > -0.5 ? 1 : 0;
  // A little off the surface, which is not as fine in the sun's map.
  point += 0.005 * normal;
  float past_people = SunPastPeople(point, 0.015, asked);
  float past_things = SunPastOccluders(point, 0.03, past_people > 0.0 ? asked : 0);
  seen = vec4(past_people * past_things);
}
