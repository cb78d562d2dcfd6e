#pragma once

// One eye's part of a head-mounted display's panel, seen through its lens. Pixels: integer
// coordinates are pixel centres, the part's top-left pixel is (0, 0). Eye axes: x right, y down,
// z forward, where the eye looks straight ahead.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "shared/core/status.h"

namespace lararium::geometry {

struct LensModel {
  // By which the lens magnifies at a distance r from its middle: 1 + k1 r^2 + k2 r^4 + k3 r^6.
  using Radial = std::array<double, 3>;
  enum Colour { kRed, kGreen, kBlue };

  int width = 0;
  int height = 0;
  double fx = 0.0;  // pixels, in the lens's middle
  double fy = 0.0;
  double cx = 0.0;  // the lens's middle
  double cy = 0.0;
  // Of each colour. A pixel at p = ((u - cx) / fx, (v - cy) / fy) is seen at p times the
  // magnification at |p|, on the plane z = 1. Positive: straight lines would look like a
  // pincushion.
  std::array<Radial, 3> radial = {};

  // Angles (radians, above 0) from straight ahead to the part's edges, as they would be seen if
  // the lens magnified everywhere as in its middle.
  static LensModel FromAngles(
      int width, int height, double left, double right, double up, double down);

  // Says what is impossible: sizes, focal lengths, numbers that are not finite, or a lens through
  // which the part folds over itself or is seen beside the eye.
  Status Validate() const;

  // Point (x, y) on the plane z = 1 where a pixel is seen.
  Eigen::Vector2d PlaneFromPixel(const Eigen::Vector2d& pixel, Colour colour = kGreen) const;

  // What of the plane z = 1 the part covers: the smallest box around it.
  Eigen::AlignedBox2d SeenBox() const;

  // The other eye's, of a display that is the same on both sides.
  LensModel Mirrored() const;

  friend bool operator==(const LensModel&, const LensModel&) = default;
};

}  // namespace lararium::geometry
