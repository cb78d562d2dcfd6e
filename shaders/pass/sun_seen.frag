// The visible share of the sun for the nearest people and props, pixel by pixel. It is a pass of
// its own, because many small triangles may share a pixel in the pass that draws them.

#include "picture_rays.glsl"
#include "sun.glsl"

uniform sampler2D nearest_depth;
uniform ivec2 last_cell;

layout(location = 0) out vec4 seen;

float DepthAt(ivec2 cell) {
  return texelFetch(nearest_depth, clamp(cell, ivec2(0), last_cell), 0).r;
}

// The change of position from one pixel to the next, measured on the side whose depth is more
// similar and so more likely belongs to the same surface.
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
  // A pixel without people but with people beside it may contain an edge.
  vec2 nearer = min(sides.xy, sides.zw);
  buffered = buffered < 1.0 ? buffered : min(nearer.x, nearer.y);
  float depth = DepthInMetres(buffered);
  vec3 point = SurfacePoint(cell, depth);
  vec3 normal = cross(Tangent(cell, kRight, point, depth, sides.x, sides.y),
                      Tangent(cell, kUp, point, depth, sides.z, sides.w));
  normal *= inversesqrt(max(dot(normal, normal), 1e-20));
  normal = dot(normal, eye_in_stage - point) < 0.0 ? -normal : normal;
  // Facets turn away from the sun a little earlier than the smooth surface that they approximate.
  int asked = buffered < 1.0 && dot(normal, sun_direction) > -0.5 ? 1 : 0;
  // Moves the point off the surface a little, because the sun's map shows it at less detail.
  point += 0.005 * normal;
  float past_people = SunPastPeople(point, 0.015, asked);
  float past_things = SunPastOccluders(point, 0.03, past_people > 0.0 ? asked : 0);
  seen = vec4(past_people * past_things);
}
