#pragma once

// Probe images defined as functions of direction.

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "editor/bake/probe.h"
#include "shared/light/sun.h"

namespace lararium::test {

using Radiance = std::function<glm::vec3(const glm::vec3& direction)>;

inline glm::vec3 ProbeDirection(double column, double row, int width, int height) {
  const double azimuth = 2.0 * std::numbers::pi * (column / width - 0.5);
  const double elevation = std::numbers::pi * (0.5 - row / height);
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
          -std::cos(elevation) * std::cos(azimuth)};
}

// Each texel is the mean over a grid of points in it.
inline bake::ProbeImage MakeProbe(int width, const Radiance& radiance, int grid = 6) {
  bake::ProbeImage image{width, width / 2, {}, {}};
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < width; ++column) {
      glm::vec3 sum(0.0f);
      for (int i = 0; i < grid * grid; ++i) {
        sum += radiance(ProbeDirection(column + (i % grid + 0.5) / grid,
                                       row + (i / grid + 0.5) / grid, width, image.height));
      }
      image.pixels.push_back(sum / static_cast<float>(grid * grid));
    }
  }
  return image;
}

// A uniform disc in front of another radiance.
inline Radiance DiscOn(Radiance behind, const light::Sun& sun) {
  const float sine = std::sin(sun.angular_radius);
  const glm::vec3 radiance = sun.irradiance / (std::numbers::pi_v<float> * sine * sine);
  const float cosine = std::cos(sun.angular_radius);
  return [=](const glm::vec3& direction) {
    return behind(direction) +
           (glm::dot(direction, sun.direction) > cosine ? radiance : glm::vec3(0.0f));
  };
}

// Sums texels.
inline glm::dvec3 Irradiance(const bake::ProbeImage& image, const glm::vec3& normal) {
  glm::dvec3 sum(0.0);
  for (int row = 0; row < image.height; ++row) {
    const double solid_angle = 2.0 * std::numbers::pi / image.width *
                               (std::cos(std::numbers::pi * row / image.height) -
                                std::cos(std::numbers::pi * (row + 1) / image.height));
    for (int column = 0; column < image.width; ++column) {
      const double cosine =
          glm::dot(ProbeDirection(column + 0.5, row + 0.5, image.width, image.height), normal);
      sum += std::max(0.0, cosine) * solid_angle *
             glm::dvec3(image.pixels[static_cast<size_t>(row) * image.width + column]);
    }
  }
  return sum;
}

}  // namespace lararium::test
