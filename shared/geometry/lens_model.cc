#include "shared/geometry/lens_model.h"

#include <algorithm>
#include <cmath>

namespace lararium::geometry {
namespace {

constexpr std::string_view kLensPlace = "lens";
constexpr double kWidestTangent = 10.0;  // tangent of 84 degrees
constexpr int kSteps = 256;              // samples from the lens centre to its rim

double Magnification(const LensModel::Radial& k, double r2) {
  return 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]));
}

// Derivative of r times the magnification, by r.
double Slope(const LensModel::Radial& k, double r2) {
  return 1.0 + r2 * (3.0 * k[0] + r2 * (5.0 * k[1] + r2 * 7.0 * k[2]));
}

// Distance from the lens centre to the furthest corner.
double Rim(const LensModel& lens) {
  const double x = std::max(lens.cx + 0.5, lens.width - 0.5 - lens.cx) / lens.fx;
  const double y = std::max(lens.cy + 0.5, lens.height - 0.5 - lens.cy) / lens.fy;
  return std::hypot(x, y);
}

Status ValidateRadial(const LensModel::Radial& k, double rim) {
  for (int i = 0; i <= kSteps; ++i) {
    const double r = rim * i / kSteps;
    if (!(Slope(k, r * r) > 0.0)) {
      return Status::Error(kLensPlace, "its distortion folds the picture over itself",
                           "check k1, k2, k3 and the direction of the distortion");
    }
  }
  if (!(rim * Magnification(k, rim * rim) < kWidestTangent)) {
    return Status::Error(kLensPlace, "its corners would be outside the eye's field of view",
                         "check k1, k2, k3 and the focal lengths");
  }
  return Status();
}

}  // namespace

LensModel LensModel::FromAngles(
    int width, int height, double left, double right, double up, double down) {
  LensModel lens{width, height};
  lens.fx = width / (std::tan(left) + std::tan(right));
  lens.fy = height / (std::tan(up) + std::tan(down));
  lens.cx = lens.fx * std::tan(left) - 0.5;
  lens.cy = lens.fy * std::tan(up) - 0.5;
  return lens;
}

Status LensModel::Validate() const {
  if (width < 16 || height < 16 || width > 16384 || height > 16384) {
    return Status::Error(kLensPlace,
                         "an eye's part of the panel must have 16 to 16384 pixels a side");
  }
  std::array<double, 13> numbers = {fx, fy, cx, cy};
  for (size_t i = 0; i < 9; ++i) {
    numbers[4 + i] = radial[i / 3][i % 3];
  }
  if (!std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); })) {
    return Status::Error(kLensPlace, "all numbers must be finite");
  }
  const double side = std::max(width, height);
  if (fx < 0.05 * side || fy < 0.05 * side || fx > 100.0 * side || fy > 100.0 * side) {
    return Status::Error(kLensPlace, "the focal length is impossible for this panel",
                         "give fx and fy in pixels");
  }
  if (cx < 0.0 || cy < 0.0 || cx > width - 1.0 || cy > height - 1.0) {
    return Status::Error(kLensPlace, "its centre is outside the eye's part of the panel",
                         "count cx from the part's own left edge");
  }
  for (const Radial& k : radial) {
    LARARIUM_RETURN_IF_ERROR(ValidateRadial(k, Rim(*this)));
  }
  return Status();
}

Eigen::Vector2d LensModel::PlaneFromPixel(const Eigen::Vector2d& pixel, Colour colour) const {
  const Eigen::Vector2d p((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  return p * Magnification(radial[colour], p.squaredNorm());
}

Eigen::AlignedBox2d LensModel::SeenBox() const {
  constexpr int kAlong = 64;  // Samples of each edge, whose extremes need not be the corners.
  Eigen::AlignedBox2d box;
  for (int i = 0; i <= kAlong; ++i) {
    const double x = -0.5 + static_cast<double>(width) * i / kAlong;
    const double y = -0.5 + static_cast<double>(height) * i / kAlong;
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(x, -0.5), Eigen::Vector2d(x, height - 0.5), Eigen::Vector2d(-0.5, y),
          Eigen::Vector2d(width - 0.5, y)}) {
      box.extend(PlaneFromPixel(pixel));
    }
  }
  return box;
}

LensModel LensModel::Mirrored() const {
  LensModel mirrored = *this;
  mirrored.cx = width - 1.0 - cx;
  return mirrored;
}

}  // namespace lararium::geometry
