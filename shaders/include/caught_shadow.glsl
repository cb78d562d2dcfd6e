// The factor on the light of a pixel of a real surface. The part for sky and lamps is upsampled
// from the coarse image of ratios; the sun's part counts only outside shadows of real objects.

#include "catcher.glsl"
#include "octahedral.glsl"
#include "sun.glsl"

uniform sampler2D sky_ratio;       // shaders/pass/sky_ratio.frag
uniform sampler2D sky_irradiance;  // irradiance without people, by normal

// Weight of a coarse cell for a point, large if both lie in the same plane (joint bilateral
// upsampling, Kopf et al., SIGGRAPH 2007, guided by plane and normal).
float PlaneWeight(ivec2 coarse, float depth, vec3 point, vec3 normal, float tolerance) {
  ivec2 cell = CoarseSource(coarse);
  float off = dot(SurfacePoint(cell, depth) - point, normal) / tolerance;
  float alike = max(dot(SurfaceNormal(texelFetch(surface_normal, cell, 0)), normal), 0.0);
  alike *= alike;
  // The minimum gives a result even if no cell fits.
  return max(exp2(-off * off) * alike * alike * alike * alike, 1e-5);
}

vec4 WeightedRatio(ivec2 coarse, float share, float depth, vec3 point, vec3 normal) {
  ivec2 low = ivec2(catcher_bounds.xy) / shadow_cell;
  ivec2 high = (ivec2(catcher_bounds.zw) - 1) / shadow_cell;
  coarse = clamp(coarse, low, high);
  vec4 texel = texelFetch(sky_ratio, coarse, 0);
  if (texel.a <= 0.0) {
    return vec4(0.0);
  }
  float tolerance = 1.5 * depth * length(ray_per_column);
  float weight = share * PlaneWeight(coarse, texel.a, point, normal, tolerance);
  return weight * vec4(texel.rgb, 1.0);
}

// True if shadows or lamps change any of the four coarse cells around a cell.
bool ChangedAbout(ivec2 first) {
  ivec2 low = ivec2(catcher_bounds.xy) / shadow_cell;
  ivec2 high = (ivec2(catcher_bounds.zw) - 1) / shadow_cell;
  vec3 most = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 coarse = clamp(first + ivec2(i & 1, i >> 1), low, high);
    most = max(most, abs(texelFetch(sky_ratio, coarse, 0).rgb - 1.0));
  }
  return any(greaterThan(most, vec3(0.002)));
}

vec3 SkyRatio(ivec2 cell, vec3 point, vec3 normal, float depth) {
  vec2 at = (vec2(cell) - float(shadow_cell / 2)) / float(shadow_cell);
  ivec2 first = ivec2(floor(at));
  vec2 part = at - vec2(first);
  vec4 sum = vec4(0.0);
  int corners = ChangedAbout(first) ? 4 : 0;
  for (int i = 0; i < corners; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1);
    vec2 share = mix(1.0 - part, part, vec2(corner));
    sum += WeightedRatio(first + corner, share.x * share.y + 1e-3, depth, point, normal);
  }
  // Along edges, none of the four cells may fit, but some of their neighbours do.
  int more = corners > 0 && sum.a < 1e-2 ? 16 : 0;
  for (int i = 0; i < more; ++i) {
    sum += WeightedRatio(first - 1 + ivec2(i & 3, i >> 2), 0.1, depth, point, normal);
  }
  return sum.a > 0.0 ? sum.rgb / sum.a : vec3(1.0);
}

// Combines the ratio of the sky (kept) with the sun.
vec3 WithSun(vec3 kept, vec3 point, vec3 normal) {
  float cosine = dot(normal, sun_direction);
  int faces = cosine > 0.0 ? 1 : 0;
  float past_people = SunPastPeople(point, 0.005, faces);
  bool changes = past_people < 0.999 || any(greaterThan(abs(kept - 1.0), vec3(1e-3)));
  float past_things = SunPastOccluders(point, 0.03, changes ? faces : 0);
  vec3 sun = max(cosine, 0.0) * past_things * sun_irradiance;
  vec3 sky = textureLod(sky_irradiance, OctahedralPosition(normal), 0.0).rgb;
  return (sky * kept + sun * past_people + 1e-6) / (sky + sun + 1e-6);
}

vec3 CaughtShadow(ivec2 cell) {
  vec4 surface = texelFetch(surface_normal, cell, 0);
  float depth = SurfaceDepth(cell);
  vec3 point = SurfacePoint(cell, depth);
  vec3 normal = SurfaceNormal(surface);
  vec3 kept = vec3(1.0);
  // Loops replace ifs: see SeenPast in shaders/include/sun.glsl.
  int receives = surface.a > 0.5 ? 1 : 0;
  for (int i = 0; i < receives; ++i) {
    kept = SkyRatio(cell, point, normal, depth);
    for (int k = 0; k < has_sun; ++k) {
      kept = WithSun(kept, point, normal);
    }
  }
  return kept;
}
