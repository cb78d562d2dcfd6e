#pragma once

// Two-view geometry that separates true matches from false ones.

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
  geometry::Rigid3 b_from_a;      // baseline of length 1
  std::vector<uint32_t> inliers;  // indices of point pairs in front of both cameras
  double median_angle = 0.0;      // radians, between the two rays to a point
};

// From points on the plane z = 1: the essential matrix by five points (Nister,
// "An efficient solution to the five-point relative pose problem", PAMI 2004)
// within RANSAC. threshold: Sampson distance on the plane. nullopt when fewer than
// eight points agree. Of a camera that only turned, the median angle is noise.
std::optional<RelativePose> EstimateRelativePose(const PointPairs& plane_points, double threshold);

// b' E a = 0 for points on the plane z = 1.
Eigen::Matrix3d EssentialMatrix(const geometry::Rigid3& b_from_a);

struct Fundamental {
  Eigen::Matrix3d matrix;  // b' F a = 0, in pixels
  std::vector<uint32_t> inliers;
};

// From pixels, without intrinsics, within RANSAC.
std::optional<Fundamental> EstimateFundamental(const PointPairs& pixels, double threshold_px);

// What a mere turn of the camera explains: the best rotation of all rays (Kabsch).
struct Turning {
  Eigen::Quaterniond b_from_a = Eigen::Quaterniond::Identity();
  double median_angle = 0.0;  // radians that points are off besides; near zero without parallax
};
// At least one pair.
Turning EstimateTurning(const PointPairs& plane_points);

struct PlanarGeometry {
  double share = 0.0;  // 0..1, of the point pairs that one homography explains
  // The poses that this homography allows with the points in front of both
  // cameras (Faugeras & Lustman, "Motion and structure from motion in a piecewise
  // planar environment", 1988): up to two, which only a third view tells apart.
  std::vector<geometry::Rigid3> b_from_a;  // baseline of length 1
};

// The share is near 1 for a plane and for a camera that only turned.
PlanarGeometry EstimatePlanarGeometry(const PointPairs& plane_points, double threshold);

// The focal length in pixels that makes the fundamental matrices most like
// essential ones, whose two singular values are equal (Mendonca & Cipolla, "A
// simple technique for self-calibration", CVPR 1999): the robust minimum over a
// grid between 0.4 and 2.5 times the longer side. Square pixels, principal point
// in the centre. nullopt when no pair says anything about it.
std::optional<double> EstimateFocal(std::span<const Fundamental> pairs, int width, int height);

}  // namespace lararium::train
