#pragma once

// The light of a place: what spherical harmonics hold, and the sun where there is one.

#include <optional>

#include "shared/light/spherical_harmonics.h"
#include "shared/light/sun.h"

namespace lararium::light {

struct ProbeLight {
  ShRgb sky = {};          // radiance without the sun, stage axes
  std::optional<Sun> sun;  // none: the sky is all

  // Sky and sun in one, for what casts no shadow of the sun.
  ShRgb Whole() const;
  // Of a unit normal that nothing shades: the sky's from harmonics, the sun's exactly.
  glm::vec3 Irradiance(const glm::vec3& normal) const;
};

// An even disc as harmonics: its flux times the mean of each zonal harmonic over the disc.
ShRgb ProjectSun(const Sun& sun);

// The light turned and brightened: stage_from_probe and the stage's radiance for one unit.
ProbeLight Placed(const ProbeLight& light, const glm::quat& stage_from_probe, float scale);

// Each channel multiplied.
ProbeLight Balanced(const ProbeLight& light, const glm::vec3& balance);

}  // namespace lararium::light
