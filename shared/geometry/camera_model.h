#pragma once

// A pinhole camera with OpenCV's radial and tangential distortion (k1, k2, p1,
// p2). Pixels: integer coordinates are pixel centres, the top-left pixel is
// (0, 0). Camera axes: x right, y down, z forward.

#include <Eigen/Core>
#include <optional>
#include <span>

#include "shared/core/json_fwd.h"
#include "shared/core/status.h"

namespace lararium::geometry {

struct CameraModel {
  int width = 0;  // size of the image, pixels
  int height = 0;
  double fx = 0.0;  // focal lengths, pixels
  double fy = 0.0;
  double cx = 0.0;  // principal point, raw pixel
  double cy = 0.0;
  // Distortion coefficients without unit. A point on the plane z = 1 at distance r from the axis
  // moves to r (1 + k1 r^2 + k2 r^4), and sideways by the tangential p1 and p2.
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;

  // Creates and checks a model from the numbers that people type: fx, fy, cx, cy[, k1, k2, p1, p2].
  static Result<CameraModel> FromNumbers(std::span<const double> numbers, int width, int height);

  // Reports an impossible field: sizes, focal lengths, non-finite numbers, or a distortion that
  // folds the image over itself.
  Status Validate() const;

  bool HasDistortion() const { return k1 != 0.0 || k2 != 0.0 || p1 != 0.0 || p2 != 0.0; }
  // Mean focal length: turns lengths on the plane z = 1 into pixels.
  double Focal() const { return 0.5 * (fx + fy); }

  // Returns the raw pixel of a point in camera coordinates; it may lie outside the image. Returns
  // nullopt behind the camera and where the distortion folds back.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_camera) const;
  // True if the radial distortion folds back before it reaches a point (x, y) on the plane z = 1.
  // Such a point is invisible, but the polynomial may map it into the image.
  bool FoldsBackAt(const Eigen::Vector2d& plane) const;
  // Returns the raw pixel of a point (x, y) on the plane z = 1; meaningless where the distortion
  // folds back.
  Eigen::Vector2d PixelFromPlane(const Eigen::Vector2d& plane) const;
  // The same, with the derivative of the pixel by the point.
  Eigen::Vector2d PixelFromPlane(const Eigen::Vector2d& plane, Eigen::Matrix2d& slope) const;
  // Returns the point (x, y) on the plane z = 1 that is seen at a raw pixel. Inverts the distortion
  // by Newton's method, to 1e-10.
  Eigen::Vector2d PlaneFromPixel(const Eigen::Vector2d& pixel) const;

  // Returns the camera for images resized to width x height: c' = s (c + 0.5) - 0.5.
  CameraModel Resized(int new_width, int new_height) const;

  // Same as Resized(), but returns an error with both sizes if the aspect ratios differ by more
  // than a pixel.
  Result<CameraModel> ForImages(int new_width, int new_height) const;

  // Same as ForImages() where that is possible. Otherwise a guess: a camera of the same field of
  // view along the longer side, with its principal point in the middle and without distortion.
  CameraModel GuessForImages(int new_width, int new_height) const;

  // Returns the undistorted pinhole of the same size whose image is completely covered by this
  // camera's image: the largest field of view without blank corners.
  CameraModel DisplayPinhole() const;

  bool Contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width - 0.5 &&
           pixel.y() < height - 0.5;
  }

  friend bool operator==(const CameraModel&, const CameraModel&) = default;
};

// Describes the size of the images and "K": fx, fy, cx and cy.
void DescribePinhole(Fields& fields, CameraModel& camera);
// Describes "k1_k2_p1_p2".
void DescribeDistortion(Fields& fields, CameraModel& camera);
// Describes and checks a camera whose distortion may be missing.
void DescribeFields(Fields& fields, CameraModel& camera);

}  // namespace lararium::geometry
