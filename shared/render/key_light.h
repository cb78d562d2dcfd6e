#pragma once

// The one direction that most light comes from, for highlights.

#include <glm/vec3.hpp>

#include "shared/light/spherical_harmonics.h"

namespace lararium::render {

struct KeyLight {
  glm::vec3 direction = glm::vec3(0.0f, 1.0f, 0.0f);  // towards the light, unit, stage axes
  glm::vec3 irradiance = glm::vec3(0.0f);             // of a surface that faces it
};

// The lamp that, with an even light around, comes closest to what the harmonics say
// (least squares; its direction is that of the linear band's luminance: Sloan,
// "Stupid Spherical Harmonics (SH) Tricks", GDC 2008). Never brighter than they are.
KeyLight EstimateKeyLight(const light::ShRgb& radiance);

}  // namespace lararium::render
