// The share of the sun that is visible past people, and past real objects. Percentage-closer soft
// shadows (Fernando, SIGGRAPH 2005 sketches): the mean depth of the blockers determines the width
// of the penumbra.

uniform int has_sun;
uniform vec3 sun_direction;   // towards the sun, unit, stage axes
uniform vec3 sun_irradiance;  // irradiance of a surface that faces the sun
uniform float sun_slope;      // tangent of the sun's angular radius

// Shadow maps. Depth grows away from the sun.
uniform highp sampler2DShadow people_map;
uniform sampler2D people_map_depth;  // the same image without comparison
uniform mat4 people_map_from_stage;  // map coordinates are 0..1
uniform vec3 people_map_size;        // metres
uniform highp sampler2DShadow occluder_map;
uniform sampler2D occluder_map_depth;
uniform mat4 occluder_map_from_stage;
uniform vec3 occluder_map_size;

// Points that cover the unit disc evenly (Vogel 1979): each direction is the previous one turned by
// the golden angle, so the loop needs no sine.
const mat2 kGoldenTurn = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688);

float DiscRadius(int index, int count) { return sqrt((float(index) + 0.5) / float(count)); }

// Number of samples in the search for blockers, and in the penumbra.
uniform int sun_searches;
uniform int sun_taps;

// Mean depth of blockers around a point, and the number of samples that found one.
vec2 Blockers(sampler2D map, vec3 at, vec2 radius, int searches) {
  float sum = 0.0;
  float count = 0.0;
  vec2 direction = vec2(1.0, 0.0);
  for (int i = 0; i < searches; ++i) {
    vec2 tap = at.xy + radius * DiscRadius(i, sun_searches) * direction;
    direction = kGoldenTurn * direction;
    float depth = textureLod(map, tap, 0.0).r;
    if (depth < min(at.z, 1.0)) {
      sum += depth;
      count += 1.0;
    }
  }
  return vec2(sum / max(count, 1.0), count);
}

// asked: 0 or 1; 0 skips the work. It sets the number of iterations, because software renderers
// (llvmpipe) skip work in loops but not in ifs.
float SeenPast(highp sampler2DShadow map, sampler2D map_depth, vec3 at, vec3 size, int asked) {
  bool within = all(greaterThan(at, vec3(0.0))) && all(lessThan(at.xy, vec2(1.0)));
  vec2 texel = 1.0 / vec2(textureSize(map, 0));
  vec2 widest = max(min(sun_slope * at.z * size.z, 0.5) / size.xy, texel);
  int searches = within ? asked * sun_searches : 0;
  vec2 blockers = Blockers(map_depth, at, widest, searches);
  vec2 radius = max(sun_slope * (at.z - blockers.x) * size.z / size.xy, 0.5 * texel);
  // If the widest possible penumbra is entirely dark or bright, its middle is too.
  bool edge = blockers.y > 0.0 && blockers.y < float(searches);
  int taps = edge ? sun_taps : 0;
  float seen = 0.0;
  vec2 direction = vec2(1.0, 0.0);
  for (int i = 0; i < taps; ++i) {
    vec2 tap = at.xy + radius * DiscRadius(i, sun_taps) * direction;
    direction = kGoldenTurn * direction;
    seen += textureLod(map, vec3(tap, min(at.z, 1.0)), 0.0);
  }
  return taps > 0 ? seen / float(taps) : blockers.y > 0.0 ? 0.0 : 1.0;
}

// clearance: metres by which the point is moved towards the sun, so that surfaces do not shadow
// themselves in a coarse map. asked: 0 if the result does not matter.
float SunPastPeople(vec3 point, float clearance, int asked) {
  vec4 at = people_map_from_stage * vec4(point + clearance * sun_direction, 1.0);
  return SeenPast(people_map, people_map_depth, at.xyz, people_map_size, asked);
}

float SunPastOccluders(vec3 point, float clearance, int asked) {
  vec4 at = occluder_map_from_stage * vec4(point + clearance * sun_direction, 1.0);
  return SeenPast(occluder_map, occluder_map_depth, at.xyz, occluder_map_size, asked);
}
