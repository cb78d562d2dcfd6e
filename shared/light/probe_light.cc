#include "shared/light/probe_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/light/cap_means.h"

namespace lararium::light {
ShRgb ProjectSun(const Sun& sun) {
  // Radiance L gives irradiance L pi sin^2(a) and flux L 2 pi (1 - cos(a)).
  const double half_sine = std::sin(0.5 * sun.angular_radius);
  const double u = half_sine * half_sine;
  const auto basis = EvaluateShBasis(sun.direction);
  ShRgb radiance;
  for (int i = 0; i < kShCount; ++i) {
    const double share = CapMean(ShBandOf(i), u) / (1.0 - u);
    radiance[i] = sun.irradiance * (static_cast<float>(share) * basis[i]);
  }
  return radiance;
}

ShRgb ProbeLight::Whole() const {
  ShRgb whole = sky;
  if (sun) {
    const ShRgb disc = ProjectSun(*sun);
    for (int i = 0; i < kShCount; ++i) {
      whole[i] += disc[i];
    }
  }
  return whole;
}

glm::vec3 ProbeLight::Irradiance(const glm::vec3& normal) const {
  glm::vec3 irradiance = EvaluateIrradiance(sky, normal);
  if (sun) {
    irradiance += std::max(0.0f, glm::dot(normal, sun->direction)) * sun->irradiance;
  }
  return irradiance;
}

ProbeLight Placed(const ProbeLight& light, const glm::quat& stage_from_probe, float scale) {
  ProbeLight placed = light;
  placed.sky = RotateSh(light.sky, stage_from_probe);
  for (glm::vec3& coefficient : placed.sky) {
    coefficient *= scale;
  }
  if (placed.sun) {
    placed.sun->direction = glm::normalize(stage_from_probe * light.sun->direction);
    placed.sun->irradiance *= scale;
  }
  return placed;
}

ProbeLight Balanced(const ProbeLight& light, const glm::vec3& balance) {
  ProbeLight balanced = light;
  for (glm::vec3& coefficient : balanced.sky) {
    coefficient *= balance;
  }
  if (balanced.sun) {
    balanced.sun->irradiance *= balance;
  }
  return balanced;
}

}  // namespace lararium::light
