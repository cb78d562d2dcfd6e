#pragma once

// The main direction of light, used for highlights.

#include <glm/vec3.hpp>

#include "shared/light/spherical_harmonics.h"

namespace lararium::render {

struct KeyLight {
  glm::vec3 direction = glm::vec3(0.0f, 1.0f, 0.0f);  // towards the light, unit, stage axes
  glm::vec3 irradiance = glm::vec3(0.0f);             // received by a surface that faces the light
};

// Fits a directional light plus a uniform light to the harmonics by least squares. The direction is
// that of the linear band's luminance (Sloan, "Stupid Spherical Harmonics (SH) Tricks", GDC 2008).
// The fitted light is never brighter than the harmonics.
KeyLight EstimateKeyLight(const light::ShRgb& radiance);

}  // namespace lararium::render
