#pragma once

// Estimates the pose of one image from matches with map points.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/training_camera.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::train {

struct Resection {
  geometry::Rigid3 camera_from_map;
  std::vector<uint32_t> inliers;  // Indices of correspondences.
};

struct ResectionOptions {
  double max_error_px = 4.0;
  size_t min_inliers = 20;
  double min_inlier_share = 0.2;
  int max_iterations = 5000;
  uint64_t seed = 1;
};

// RANSAC with P3P, then robust least squares on the inliers. pixels[i] shows points[i]. nullopt if
// too few correspondences agree.
std::optional<Resection> LocateImage(const geometry::CameraModel& camera,
                                     std::span<const Eigen::Vector2d> pixels,
                                     std::span<const Eigen::Vector3d> points,
                                     const ResectionOptions& options);

struct LensResection {
  Resection resection;
  geometry::CameraModel camera;
};

// Locates an image whose camera has an unknown focal length and radial distortion: tries focal
// lengths from 0.4 to 2.5 times that of `guess`, then adjusts the intrinsics with the pose.
std::optional<LensResection> LocateImageAndLens(const TrainingCamera& guess,
                                                std::span<const Eigen::Vector2d> pixels,
                                                std::span<const Eigen::Vector3d> points,
                                                const ResectionOptions& options);

}  // namespace lararium::train
