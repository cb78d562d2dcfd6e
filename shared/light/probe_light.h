#pragma once

// The light of a place: spherical harmonics, and the sun if there is one.

#include <optional>

#include "shared/light/spherical_harmonics.h"
#include "shared/light/sun.h"

namespace lararium::light {

struct ProbeLight {
  ShRgb sky = {};          // radiance without the sun, stage axes
  std::optional<Sun> sun;  // Not set if the sky is all the light.

  // Returns sky and sun combined, for surfaces that get no shadow of the sun.
  ShRgb Whole() const;
  // Returns the unshadowed irradiance at a unit normal: the sky's from harmonics, the sun's
  // exactly.
  glm::vec3 Irradiance(const glm::vec3& normal) const;
};

// Projects a uniform disc: its flux times the mean of each zonal harmonic over the disc.
ShRgb ProjectSun(const Sun& sun);

// Rotates the light into the stage and scales it: stage_from_probe, and the stage's radiance for
// one unit of the probe.
ProbeLight Placed(const ProbeLight& light, const glm::quat& stage_from_probe, float scale);

// Multiplies each channel by its factor.
ProbeLight Balanced(const ProbeLight& light, const glm::vec3& balance);

}  // namespace lararium::light
