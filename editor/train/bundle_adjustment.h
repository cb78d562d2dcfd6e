#pragma once

// Least squares over poses, points and intrinsics: Triggs et al., "Bundle
// Adjustment - A Modern Synthesis", 2000.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/reconstruction.h"

namespace lararium::train {

// What the estimated intrinsics change: fx, k1, k2, cx, cy; fy / fx is kept.
inline constexpr int kIntrinsics = 5;
using IntrinsicsBlock = std::array<double, kIntrinsics>;
IntrinsicsBlock ToIntrinsicsBlock(const geometry::CameraModel& camera);
// camera_from_map: quaternion x, y, z, w, then translation.
using PoseBlock = std::array<double, 7>;
PoseBlock ToPoseBlock(const geometry::Rigid3& pose);
geometry::Rigid3 ToPose(const PoseBlock& block);

// Projection of a point by a camera less the pixel where it was seen. Each
// Jacobian that is not null is filled, row by row.
// fixed: the parameters of camera that IntrinsicsBlock does not hold.
// False behind the camera.
bool ReprojectionResidual(const geometry::CameraModel& fixed,
                          const Eigen::Vector2d& pixel,
                          const double* intrinsics,
                          const double* pose,
                          const double* point,
                          double* residual,
                          double* by_intrinsics,  // [2][kIntrinsics]
                          double* by_pose,        // [2][7]
                          double* by_point);      // [2][3]

struct BundleOptions {
  int max_iterations = 30;
  double loss_scale_px = 1.5;  // of Cauchy's loss
  double function_tolerance = 1e-6;
  bool refine_intrinsics = false;  // focal length and two radial terms
  bool refine_centre = false;      // with these, the principal point
  // Enough of the most observed points take part that each image sees so many of
  // them; AdjustAll intersects the others again afterwards. 0: all.
  size_t points_per_image = 0;
};

// Adjusts all located images and all points. The first of anchors keeps its pose;
// the distance between both keeps its length: they fix axes and unit.
// False when no solution was found; nothing has changed then.
bool AdjustAll(Reconstruction& reconstruction,
               const std::array<uint32_t, 2>& anchors,
               const BundleOptions& options);

// Adjusts the poses of images and the points that the first of them observes (the
// most observed points_per_image of these, where given); other images that see
// these points hold still, and so do points that many see.
bool AdjustLocally(Reconstruction& reconstruction,
                   std::span<const uint32_t> images,
                   const BundleOptions& options);

// Robust least squares of one pose on fixed points.
std::optional<geometry::Rigid3> AdjustPose(const geometry::CameraModel& camera,
                                           std::span<const Eigen::Vector2d> pixels,
                                           std::span<const Eigen::Vector3d> points,
                                           const geometry::Rigid3& start,
                                           const BundleOptions& options);

// Standard deviations of estimated intrinsics, from the residuals and the normal
// equations of AdjustAll; 0 where they are singular or were not refined.
struct IntrinsicsDeviation {
  double focal_px = 0.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
};
IntrinsicsDeviation EstimateDeviation(const Reconstruction& reconstruction,
                                      uint32_t anchor,
                                      bool centre_refined);

}  // namespace lararium::train
