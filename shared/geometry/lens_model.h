#pragma once

// One eye's part of a head-mounted display's panel, seen through its lens. Pixels: integer
// coordinates are pixel centres, the part's top-left pixel is (0, 0). Eye axes: x right, y down, z
// straight ahead.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "shared/core/status.h"

namespace lararium::geometry {

struct LensModel {
  // Coefficients of the magnification at distance r from the lens centre: 1 + k1 r^2 + k2 r^4 + k3
  // r^6.
  using Radial = std::array<double, 3>;
  enum Colour { kRed, kGreen, kBlue };

  int width = 0;
  int height = 0;
  double fx = 0.0;  // focal lengths at the lens centre, pixels
  double fy = 0.0;
  double cx = 0.0;  // lens centre, pixels
  double cy = 0.0;
  // Magnification for each colour. A pixel at p = ((u - cx) / fx, (v - cy) / fy) appears on the
  // plane z = 1 at p times the magnification at |p|. Positive coefficients give pincushion
  // distortion.
  std::array<Radial, 3> radial = {};

  // Creates a model from the angles (radians, positive) between straight ahead and the part's
  // edges, for the magnification at the lens centre.
  static LensModel FromAngles(
      int width, int height, double left, double right, double up, double down);

  // Reports impossible values: sizes, focal lengths, non-finite numbers, or a lens that folds the
  // part over itself or shows it outside the field of view.
  Status Validate() const;

  // Returns the point (x, y) on the plane z = 1 at which a pixel appears.
  Eigen::Vector2d PlaneFromPixel(const Eigen::Vector2d& pixel, Colour colour = kGreen) const;

  // Returns the smallest box on the plane z = 1 around the visible part.
  Eigen::AlignedBox2d SeenBox() const;

  // Returns the model of the other eye, for a symmetric display.
  LensModel Mirrored() const;

  friend bool operator==(const LensModel&, const LensModel&) = default;
};

}  // namespace lararium::geometry
