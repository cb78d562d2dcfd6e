#include "shared/light/spherical_harmonics.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "shared/core/check.h"

namespace lararium::light {
namespace {

constexpr double kPi = std::numbers::pi;

// Constant factors of the basis: sqrt(1 / 4 pi), sqrt(3 / 4 pi), sqrt(15 / 4 pi),
// sqrt(5 / 16 pi), sqrt(15 / 16 pi).
constexpr float kDegree0 = 0.28209479f;
constexpr float kDegree1 = 0.48860251f;
constexpr float kMixed = 1.09254843f;
constexpr float kZonal = 0.31539157f;
constexpr float kDifference = 0.54627422f;

// Degree 2 is a quadratic form without trace: f(d) = d' Q d.
glm::mat3 QuadraticForm(const std::array<float, kShCount>& c) {
  const float xy = 0.5f * kMixed * c[4];
  const float yz = 0.5f * kMixed * c[5];
  const float xz = 0.5f * kMixed * c[7];
  const float zonal = kZonal * c[6];
  const float difference = kDifference * c[8];
  return glm::mat3(difference - zonal, xy, xz,   //
                   xy, -difference - zonal, yz,  //
                   xz, yz, 2.0f * zonal);
}

// Rotates one channel. Degree 1 is a vector, degree 2 a quadratic form.
std::array<float, kShCount> RotateChannel(const std::array<float, kShCount>& c,
                                          const glm::mat3& rotation) {
  const glm::vec3 linear = rotation * glm::vec3(c[3], c[1], c[2]);
  const glm::mat3 q = rotation * QuadraticForm(c) * glm::transpose(rotation);
  return {c[0],
          linear.y,
          linear.z,
          linear.x,
          q[0][1] * 2.0f / kMixed,
          q[1][2] * 2.0f / kMixed,
          q[2][2] / (2.0f * kZonal),
          q[0][2] * 2.0f / kMixed,
          (q[0][0] - q[1][1]) / (2.0f * kDifference)};
}

}  // namespace

std::array<float, kShCount> EvaluateShBasis(const glm::vec3& d) {
  return {kDegree0,
          kDegree1 * d.y,
          kDegree1 * d.z,
          kDegree1 * d.x,
          kMixed * d.x * d.y,
          kMixed * d.y * d.z,
          kZonal * (3.0f * d.z * d.z - 1.0f),
          kMixed * d.x * d.z,
          kDifference * (d.x * d.x - d.y * d.y)};
}

glm::vec3 EvaluateRadiance(const ShRgb& radiance, const glm::vec3& direction) {
  const std::array<float, kShCount> basis = EvaluateShBasis(direction);
  glm::vec3 sum(0.0f);
  for (int k = 0; k < kShCount; ++k) {
    sum += basis[k] * radiance[k];
  }
  return sum;
}

glm::vec3 EvaluateIrradiance(const ShRgb& radiance, const glm::vec3& normal) {
  constexpr float kCosineLobe[3] = {static_cast<float>(kPi), static_cast<float>(2.0 * kPi / 3.0),
                                    static_cast<float>(kPi / 4.0)};
  const std::array<float, kShCount> basis = EvaluateShBasis(normal);
  glm::vec3 sum(0.0f);
  for (int k = 0; k < kShCount; ++k) {
    const int degree = k == 0 ? 0 : k < 4 ? 1 : 2;
    sum += kCosineLobe[degree] * basis[k] * radiance[k];
  }
  return glm::max(sum, glm::vec3(0.0f));
}

ShRgb RotateSh(const ShRgb& radiance, const glm::quat& rotation) {
  const glm::mat3 matrix = glm::mat3_cast(rotation);
  ShRgb rotated;
  for (int channel = 0; channel < 3; ++channel) {
    std::array<float, kShCount> coefficients;
    for (int k = 0; k < kShCount; ++k) {
      coefficients[k] = radiance[k][channel];
    }
    coefficients = RotateChannel(coefficients, matrix);
    for (int k = 0; k < kShCount; ++k) {
      rotated[k][channel] = coefficients[k];
    }
  }
  return rotated;
}

ShRgb ProjectEquirectangular(std::span<const glm::vec3> pixels, int width, int height) {
  CHECK(width > 0 && height > 0 && pixels.size() == static_cast<size_t>(width) * height);
  std::array<glm::dvec3, kShCount> sums{};
  for (int row = 0; row < height; ++row) {
    const double elevation = kPi * (0.5 - (row + 0.5) / height);
    // The exact solid angle of a pixel between two circles of latitude.
    const double half_step = 0.5 * kPi / height;
    const double solid_angle =
        2.0 * kPi / width * (std::sin(elevation + half_step) - std::sin(elevation - half_step));
    for (int column = 0; column < width; ++column) {
      const double azimuth = 2.0 * kPi * ((column + 0.5) / width - 0.5);
      const glm::vec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                -std::cos(elevation) * std::cos(azimuth));
      const std::array<float, kShCount> basis = EvaluateShBasis(direction);
      const glm::dvec3 weighted =
          solid_angle * glm::dvec3(pixels[static_cast<size_t>(row) * width + column]);
      for (int k = 0; k < kShCount; ++k) {
        sums[k] += static_cast<double>(basis[k]) * weighted;
      }
    }
  }
  ShRgb radiance;
  for (int k = 0; k < kShCount; ++k) {
    radiance[k] = glm::vec3(sums[k]);
  }
  return radiance;
}

}  // namespace lararium::light
