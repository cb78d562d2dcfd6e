#pragma once

// A small, distant, bright source, separate from the rest of a place's light. It casts shadows with
// sharp edges, which spherical harmonics cannot represent.

#include <glm/vec3.hpp>

namespace lararium {
class Fields;
}

namespace lararium::light {

struct Sun {
  glm::vec3 direction = glm::vec3(0.0f, 1.0f, 0.0f);  // unit vector towards the sun, stage axes
  glm::vec3 irradiance = glm::vec3(0.0f);  // linear RGB, on a facing surface without shadow
  float angular_radius = 0.00465f;  // Radians, uniform disc; the default is that of the real sun.
};

// Sources with a larger angular radius are no suns: harmonics represent them well.
inline constexpr float kMaxSunRadius = 0.0873f;  // radians, 5 degrees

// JSON format in manifests and baked files: {"direction", "irradiance", "angular_radius"}.
void DescribeFields(Fields& fields, Sun& sun);

}  // namespace lararium::light
