#pragma once

#include <Eigen/Core>

#include "shared/geometry/lens_model.h"

namespace lararium::test {

// Finds the pixel at which a point of the plane z = 1 appears, by bisection along the ray from the
// lens centre.
inline Eigen::Vector2d PixelThrough(
    const geometry::LensModel& lens,
    const Eigen::Vector2d& plane,
    geometry::LensModel::Colour colour = geometry::LensModel::kGreen) {
  const auto pixel_at = [&](double share) {
    return Eigen::Vector2d(lens.cx + lens.fx * share * plane.x(),
                           lens.cy + lens.fy * share * plane.y());
  };
  double low = 0.0;
  double high = 4.0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    const bool beyond =
        lens.PlaneFromPixel(pixel_at(middle), colour).squaredNorm() > plane.squaredNorm();
    (beyond ? high : low) = middle;
  }
  return pixel_at(low);
}

}  // namespace lararium::test
