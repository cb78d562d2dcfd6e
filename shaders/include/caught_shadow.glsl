// What a real surface's pixel keeps of its light, from the coarse image of ratios.

#include "catcher.glsl"

uniform sampler2D sky_ratio;  // shaders/pass/sky_ratio.frag

// How much a coarse cell says about a point: it must lie in the same plane (joint bilateral
// upsampling, Kopf et al., SIGGRAPH 2007, with the distance from the plane for guide).
float PlaneWeight(ivec2 coarse, float depth, vec3 point, vec3 normal, float tolerance) {
  float off = dot(SurfacePoint(CoarseSource(coarse), depth) - point, normal) / tolerance;
  // Far from the plane a little is left, so that something is said where nothing fits.
  return exp2(-min(off * off, 16.0));
}

vec3 SkyRatio(ivec2 cell, vec3 point, vec3 normal, float depth) {
  vec2 at = (vec2(cell) - float(kCoarse / 2)) / float(kCoarse);
  ivec2 first = ivec2(floor(at));
  vec2 part = at - vec2(first);
  ivec2 low = ivec2(catcher_bounds.xy) / kCoarse;
  ivec2 high = (ivec2(catcher_bounds.zw) - 1) / kCoarse;
  float tolerance = 1.5 * depth * length(ray_per_column);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1);
    ivec2 coarse = clamp(first + corner, low, high);
    vec4 texel = texelFetch(sky_ratio, coarse, 0);
    if (texel.a > 0.0) {
      vec2 share = mix(1.0 - part, part, vec2(corner));
      float weight =
          (share.x * share.y + 1e-3) * PlaneWeight(coarse, texel.a, point, normal, tolerance);
      sum += weight * vec4(texel.rgb, 1.0);
    }
  }
  return sum.a > 0.0 ? sum.rgb / sum.a : vec3(1.0);
}

vec3 CaughtShadow(ivec2 cell) {
  vec4 surface = texelFetch(surface_normal, cell, 0);
  if (surface.a < 0.5) {
    return vec3(1.0);
  }
  float depth = SurfaceDepth(cell);
  return SkyRatio(cell, SurfacePoint(cell, depth), SurfaceNormal(surface), depth);
}
