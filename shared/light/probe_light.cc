#include "shared/light/probe_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lararium::light {
namespace {

// The means of the Legendre polynomials P_l over a cap: the integral of P_l from
// cos(radius) to 1 is (P_l-1 - P_l+1)(cos(radius)) / (2 l + 1).
std::array<double, kShDegree + 1> CapMeans(double radius) {
  const double x = std::cos(radius);
  const double height = 2.0 * std::pow(std::sin(0.5 * radius), 2.0);  // 1 - x, exactly
  std::array<double, kShDegree + 1> means;
  means.fill(1.0);
  if (height < 1e-9) {
    return means;  // a point
  }
  std::array<double, kShDegree + 2> legendre = {1.0, x};
  for (int l = 1; l <= kShDegree; ++l) {
    legendre[l + 1] = ((2 * l + 1) * x * legendre[l] - l * legendre[l - 1]) / (l + 1);
    means[l] = (legendre[l - 1] - legendre[l + 1]) / ((2 * l + 1) * height);
  }
  return means;
}

}  // namespace

ShRgb ProjectSun(const Sun& sun) {
  // Radiance L gives irradiance L pi sin^2 and flux L 2 pi (1 - cos).
  const double cosine = std::cos(0.5 * sun.angular_radius);
  const auto flux_over_irradiance = static_cast<float>(1.0 / (cosine * cosine));
  const std::array<double, kShDegree + 1> means = CapMeans(sun.angular_radius);
  const auto basis = EvaluateShBasis(sun.direction);
  ShRgb radiance;
  for (int i = 0; i < kShCount; ++i) {
    radiance[i] =
        sun.irradiance * (flux_over_irradiance * static_cast<float>(means[ShBandOf(i)]) * basis[i]);
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

}  // namespace lararium::light
