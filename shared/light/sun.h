#pragma once

// A small bright source far away, apart from the rest of a place's light: it casts
// shadows with edges, which spherical harmonics cannot.

#include <glm/vec3.hpp>

namespace lararium::light {

struct Sun {
  glm::vec3 direction = glm::vec3(0.0f, 1.0f, 0.0f);  // unit, towards it, stage axes
  glm::vec3 irradiance = glm::vec3(0.0f);  // of a surface that faces it, linear RGB, unshadowed
  float angular_radius = 0.00465f;         // radians, of an even disc; the real sun's unless known
};

// Sources that look larger than this are no suns: harmonics hold them well.
inline constexpr float kMaxSunRadius = 0.0873f;  // radians, 5 degrees

}  // namespace lararium::light
