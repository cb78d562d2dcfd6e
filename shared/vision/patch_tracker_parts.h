#pragma once

// Shared by the sources of PatchTracker only: patch_tracker.cc (the steps of a frame),
// patch_tracker_patches.cc (the choice of patches) and patch_tracker_pose.cc (the pose).

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "shared/geometry/camera_model.h"
#include "shared/vision/image_pyramid.h"

namespace lararium::vision {

inline constexpr double kBorderPx = 6.0;  // Minimum distance of a patch to the image border.
inline constexpr float kLeastCorrelation = 0.7f;  // Lowest correlation that counts as a match.
inline constexpr double kLeastShare = 0.15;       // Minimum share of agreeing patches.
inline constexpr uint32_t kRestFailed = 20;  // Frames until a failed point may be chosen again.

inline bool InsideBy(const geometry::CameraModel& camera,
                     const Eigen::Vector2d& pixel,
                     double border) {
  return pixel.x() >= border && pixel.y() >= border && pixel.x() <= camera.width - 1 - border &&
         pixel.y() <= camera.height - 1 - border;
}

// The derivative of the raw pixel by the position on the plane z = 1.
inline Eigen::Matrix2d PixelFromPlaneSlope(const geometry::CameraModel& camera,
                                           const Eigen::Vector2d& plane) {
  Eigen::Matrix2d slope = Eigen::Vector2d(camera.fx, camera.fy).asDiagonal();
  if (camera.HasDistortion()) {
    constexpr double kStep = 1e-4;
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(i);
      slope.col(i) = (camera.PixelFromPlane(plane + step) - camera.PixelFromPlane(plane - step)) /
                     (2.0 * kStep);
    }
  }
  return slope;
}

inline int Coarsest(const ImagePyramid& image) {
  return std::min(image.levels() - 1, CoarsestLevel(image.level(0).cols));
}

// Index of the cell that holds a pixel, in an image divided into columns and rows.
inline int CellIn(const geometry::CameraModel& camera,
                  const Eigen::Vector2d& pixel,
                  int columns,
                  int rows) {
  const int column =
      std::clamp(static_cast<int>(pixel.x() * columns / camera.width), 0, columns - 1);
  const int row = std::clamp(static_cast<int>(pixel.y() * rows / camera.height), 0, rows - 1);
  return row * columns + column;
}

}  // namespace lararium::vision
