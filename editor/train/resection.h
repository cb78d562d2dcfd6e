#pragma once

// The pose of one image from points of the map.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::train {

struct Resection {
  geometry::Rigid3 camera_from_map;
  std::vector<uint32_t> inliers;  // indices of correspondences
};

struct ResectionOptions {
  double max_error_px = 4.0;
  size_t min_inliers = 20;
  double min_inlier_share = 0.2;
  int max_iterations = 5000;
  uint64_t seed = 1;
};

// Three-point poses within RANSAC, then robust least squares on the inliers. nullopt when too few
// correspondences agree.
std::optional<Resection> LocateImage(const geometry::CameraModel& camera,
                                     std::span<const Eigen::Vector2d> pixels,
                                     std::span<const Eigen::Vector3d> points,
                                     const ResectionOptions& options);

}  // namespace lararium::train
