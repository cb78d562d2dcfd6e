#pragma once

// Bundle adjustment: least squares over poses, points and intrinsics (Triggs et al., "Bundle
// Adjustment - A Modern Synthesis", 2000).

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/reconstruction.h"

namespace lararium::train {

// The intrinsics that are adjusted: fx, k1, k2, cx, cy, and the readout time along x and y (see
// vision::RollingShutter). The ratio fy / fx stays constant.
inline constexpr int kIntrinsics = 7;
using IntrinsicsBlock = std::array<double, kIntrinsics>;
IntrinsicsBlock ToIntrinsicsBlock(const geometry::CameraModel& camera,
                                  const Eigen::Vector2d& readout = Eigen::Vector2d::Zero());
// A camera_from_map: quaternion x, y, z, w, then the translation.
using PoseBlock = std::array<double, 7>;
PoseBlock ToPoseBlock(const geometry::Rigid3& pose);
geometry::Rigid3 ToPose(const PoseBlock& block);

// Computes the projection of a point minus its observed pixel. Fills in each Jacobian that is not
// null, row by row. fixed supplies the parameters that IntrinsicsBlock does not hold. motion: of
// the camera during one frame time. Returns false for points behind the camera.
bool ReprojectionResidual(const geometry::CameraModel& fixed,
                          const ImageMotion& motion,
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
  double loss_scale_px = 1.5;  // Scale of Cauchy's loss.
  double function_tolerance = 1e-6;
  // Also adjusts focal length and two radial terms of each camera whose intrinsics are not given.
  bool refine_intrinsics = false;
  bool refine_radial = true;    // If false, the radial terms stay; needs refine_intrinsics.
  bool refine_centre = false;   // Also adjusts the principal point; needs refine_intrinsics.
  bool refine_readout = false;  // Also adjusts the readout time.
  // Also adjusts by how much autofocus has moved the lens in each image; see
  // Reconstruction::LetBreathe.
  bool refine_breathing = false;
  // If not 0, only the most observed points take part, enough of them that each image sees this
  // many. AdjustAll triangulates the other points again afterwards. 0: all points take part.
  size_t points_per_image = 0;
};

// Adjusts all located images and all points. The first anchor keeps its pose and the distance
// between both anchors stays constant, which fixes the axes and the unit. Returns false and changes
// nothing if no solution was found.
bool AdjustAll(Reconstruction& reconstruction,
               const std::array<uint32_t, 2>& anchors,
               const BundleOptions& options);

// Adjusts the poses of images and the points that the first of them observes (of these, only the
// points_per_image most observed ones, if that is given). Other images that see these points stay
// fixed, and so do points with many observations.
bool AdjustLocally(Reconstruction& reconstruction,
                   std::span<const uint32_t> images,
                   const BundleOptions& options);

struct PosedView {
  geometry::Rigid3 camera_from_map;
  geometry::CameraModel camera;
};

// Adjusts one pose, and the intrinsics if the options say so, to fixed points by robust least
// squares.
std::optional<PosedView> AdjustView(const TrainingCamera& camera,
                                    std::span<const Eigen::Vector2d> pixels,
                                    std::span<const Eigen::Vector3d> points,
                                    const geometry::Rigid3& start,
                                    const BundleOptions& options);

// Standard deviations of the estimated intrinsics of a camera. 0 for parameters that were not
// refined, and if the normal equations are singular.
struct IntrinsicsDeviation {
  double focal_px = 0.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  double readout_x = 0.0;
  double readout_y = 0.0;
};
// The deviations of each camera from the residuals and the normal equations of AdjustAll, as if the
// errors of the observations were independent and the camera were as it is modelled. options: as
// those with which the parameters were refined.
std::vector<IntrinsicsDeviation> EstimateDeviations(const Reconstruction& reconstruction,
                                                    uint32_t anchor,
                                                    const BundleOptions& options);
// The deviations of the main camera without these assumptions. Observations of one image share
// errors, such as those of how the camera moved meanwhile, and so do those of one point; their sums
// count (Cameron, Gelbach & Miller, "Robust inference with multiway clustering", JBES 2011). What
// is assumed of a camera and not estimated, its principal point and the ratio of its focal lengths,
// may be wrong (a consider covariance; Schmidt, "Application of state-space methods to navigation
// problems", 1966).
IntrinsicsDeviation EstimateDeviation(const Reconstruction& reconstruction,
                                      uint32_t anchor,
                                      const BundleOptions& options);

}  // namespace lararium::train
