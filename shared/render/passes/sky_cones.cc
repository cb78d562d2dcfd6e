#include "shared/render/passes/sky_cones.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "shared/light/octahedral.h"

namespace lararium::render {
namespace {

// Factor on a band of harmonics when the function is averaged over a cap (zonal coefficients of the
// cap; Ramamoorthi & Hanrahan 2001).
float CapFactor(int degree, double cosine) {
  if (degree == 0) {
    return 1.0f;
  }
  double before = 1.0, value = cosine, next = 0.0;  // Legendre polynomials of consecutive degrees
  for (int l = 1; l < degree; ++l) {
    next = ((2 * l + 1) * cosine * value - l * before) / (l + 1);
    before = value;
    value = next;
  }
  next = ((2 * degree + 1) * cosine * value - degree * before) / (degree + 1);
  return static_cast<float>((before - next) / ((2 * degree + 1) * (1.0 - cosine)));
}

template <typename ValueAt>
void FillMap(std::vector<glm::vec4>& map, const ValueAt& value) {
  map.resize(size_t{kSkyMapSize} * kSkyMapSize);
  for (int row = 0; row < kSkyMapSize; ++row) {
    for (int column = 0; column < kSkyMapSize; ++column) {
      const auto at = [](int i) {
        return (2.0f * static_cast<float>(i) + 1.0f) / kSkyMapSize - 1.0f;
      };
      map[static_cast<size_t>(row * kSkyMapSize + column)] =
          glm::vec4(value(light::OctahedralDirection({at(column), at(row)})), 1.0f);
    }
  }
}

}  // namespace

glm::vec3 SkyConeAxis() { return glm::normalize(glm::vec3(-0.53f, -0.61f, 0.59f)); }

const std::array<glm::vec4, kSkyConeCount>& SkyCones() {
  static const std::array<glm::vec4, kSkyConeCount> cones = [] {
    std::array<glm::vec4, kSkyConeCount> made;
    const glm::vec3 axis = SkyConeAxis();
    const glm::vec3 first = glm::normalize(glm::cross(axis, glm::vec3(0.0f, 1.0f, 0.0f)));
    const glm::vec3 second = glm::cross(axis, first);
    const float golden = std::numbers::pi_v<float> * (3.0f - std::sqrt(5.0f));
    for (int i = 0; i < kSkyConeCount; ++i) {
      const float share = (static_cast<float>(i) + 0.5f) / kSkyConeCount;
      const float sine = std::sqrt(share);
      const float cosine = std::sqrt(1.0f - share);
      const float turn = golden * static_cast<float>(i);
      const glm::vec3 direction =
          sine * (std::cos(turn) * first + std::sin(turn) * second) + cosine * axis;
      // Equates the solid angle pi / (count cos t) with that of a cap, 2 pi (1 - cos half).
      made[static_cast<size_t>(i)] = {direction, 1.0f - 0.5f / (kSkyConeCount * cosine)};
    }
    return made;
  }();
  return cones;
}

void FillSkyMap(const light::ShRgb& light, std::vector<glm::vec4>& radiance) {
  constexpr double kCosine = 1.0 - 0.5 / (kSkyConeCount * 0.7);  // a cone of average width
  light::ShRgb blurred = light;
  for (int k = 0; k < light::kShCount; ++k) {
    blurred[static_cast<size_t>(k)] *= CapFactor(light::ShBandOf(k), kCosine);
  }
  FillMap(radiance, [&](const glm::vec3& direction) {
    return glm::max(light::EvaluateRadiance(blurred, direction), glm::vec3(0.0f));
  });
}

void FillIrradianceMap(const light::ShRgb& light, std::vector<glm::vec4>& irradiance) {
  FillMap(irradiance,
          [&](const glm::vec3& normal) { return light::EvaluateIrradiance(light, normal); });
}

}  // namespace lararium::render
