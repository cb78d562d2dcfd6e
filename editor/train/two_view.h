#pragma once

// Two-view geometry, by which true matches are separated from false ones.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "shared/geometry/transform.h"

namespace lararium::train {

// Corresponding points of two images, by index.
struct PointPairs {
  std::vector<Eigen::Vector2d> a;
  std::vector<Eigen::Vector2d> b;

  size_t size() const { return a.size(); }
};

struct RelativePose {
  geometry::Rigid3 b_from_a;      // The baseline has length 1.
  std::vector<uint32_t> inliers;  // Indices of point pairs in front of both cameras.
  double median_angle = 0.0;      // Median angle between the two rays to a point, radians.
};

// Estimates the relative pose from points on the plane z = 1: the essential matrix by RANSAC with
// five points (Nister, "An efficient solution to the five-point relative pose problem", PAMI 2004).
// threshold is a Sampson distance on the plane. nullopt if fewer than eight points agree. If the
// camera only turned, the median angle is noise.
std::optional<RelativePose> EstimateRelativePose(const PointPairs& plane_points, double threshold);

// The matrix E with b' E a = 0 for points on the plane z = 1.
Eigen::Matrix3d EssentialMatrix(const geometry::Rigid3& b_from_a);

struct Fundamental {
  Eigen::Matrix3d matrix;  // F with b' F a = 0, in pixels.
  std::vector<uint32_t> inliers;
};

// Estimates the fundamental matrix from pixels by RANSAC, without intrinsics.
std::optional<Fundamental> EstimateFundamental(const PointPairs& pixels, double threshold_px);

// A pure rotation of the camera: the best rotation of all rays (Kabsch).
struct Turning {
  Eigen::Quaterniond b_from_a = Eigen::Quaterniond::Identity();
  double median_angle = 0.0;  // Median residual of the rays, radians; near zero without parallax.
};
// Requires at least one pair.
Turning EstimateTurning(const PointPairs& plane_points);

struct PlanarGeometry {
  double share = 0.0;  // Share of the point pairs that one homography explains, 0..1.
  // The poses that this homography allows with the points in front of both cameras (Faugeras &
  // Lustman, "Motion and structure from motion in a piecewise planar environment", 1988). There are
  // up to two, which only a third view can tell apart. Baselines have length 1.
  std::vector<geometry::Rigid3> b_from_a;
};

// The share is near 1 for a planar scene and for a camera that only turned.
PlanarGeometry EstimatePlanarGeometry(const PointPairs& plane_points, double threshold);

// Estimates the focal length by self-calibration: it makes the fundamental matrices most similar to
// essential ones, whose two singular values are equal (Mendonca & Cipolla, "A simple technique for
// self-calibration", CVPR 1999). The matrices and the result are in units of the image's longer
// side, the positions relative to the principal point. The result is the robust minimum over a grid
// between 0.4 and 2.5. nullopt if the pairs do not determine it.
std::optional<double> EstimateFocal(std::span<const Fundamental> pairs);

}  // namespace lararium::train
