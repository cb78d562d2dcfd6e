// Reflections of the surroundings on rough surfaces (shared/light/glossy_map.h).

#include "octahedral.glsl"

uniform highp sampler3D glossy;  // octahedral maps, one layer for each roughness
uniform vec3 glossy_scale;       // brightness of the current light divided by that of the map

const float kLeastRoughness = 0.1;

// Radiance around a mirrored direction. The outermost texels have their centres on the map's
// border.
vec3 Mirrored(vec3 direction, float roughness) {
  vec3 size = vec3(textureSize(glossy, 0));
  float layer = clamp((roughness - kLeastRoughness) / (1.0 - kLeastRoughness), 0.0, 1.0);
  vec3 at = vec3(OctahedralPosition(direction), layer) * (size - 1.0) + 0.5;
  return glossy_scale * textureLod(glossy, at / size, 0.0).rgb;
}
