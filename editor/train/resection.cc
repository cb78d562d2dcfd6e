#include "editor/train/resection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "editor/train/bundle_adjustment.h"
#include "shared/core/check.h"
#include "shared/core/random.h"
#include "shared/geometry/p3p.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

// Sum of the squared distances on the plane z = 1, each truncated at the threshold (MSAC: Torr &
// Zisserman, "MLESAC", CVIU 2000). Stops early once the sum exceeds limit.
double RobustCost(std::span<const Eigen::Vector2d> plane_points,
                  std::span<const Eigen::Vector3d> points,
                  const Rigid3& camera_from_map,
                  double squared_threshold,
                  double limit) {
  const Eigen::Matrix3d rotation = camera_from_map.rotation.toRotationMatrix();
  double cost = 0.0;
  for (size_t i = 0; i < points.size() && cost < limit; ++i) {
    const Eigen::Vector3d in_camera = rotation * points[i] + camera_from_map.translation;
    const double error = in_camera.z() > 1e-9
                             ? (in_camera.hnormalized() - plane_points[i]).squaredNorm()
                             : squared_threshold;
    cost += std::min(error, squared_threshold);
  }
  return cost;
}

std::optional<Rigid3> EstimateByRansac(const CameraModel& camera,
                                       std::span<const Eigen::Vector2d> pixels,
                                       std::span<const Eigen::Vector3d> points,
                                       const ResectionOptions& options) {
  CHECK(pixels.size() == points.size());
  if (pixels.size() < options.min_inliers) {
    return std::nullopt;
  }
  std::vector<Eigen::Vector2d> plane_points;
  for (const Eigen::Vector2d& pixel : pixels) {
    plane_points.push_back(camera.PlaneFromPixel(pixel));
  }
  const double threshold = options.max_error_px / camera.Focal();
  const double all_outliers = threshold * threshold * static_cast<double>(points.size());
  Random random(options.seed);
  std::optional<Rigid3> best;
  double best_cost = all_outliers;
  double needed = options.max_iterations;
  for (int i = 0; i < needed && i < options.max_iterations; ++i) {
    std::array<Eigen::Vector3d, 3> rays;
    std::array<Eigen::Vector3d, 3> sample;
    for (size_t k = 0; k < 3; ++k) {  // A sample with a repeated point has no solution.
      const uint32_t index = random.Below(static_cast<uint32_t>(points.size()));
      rays[k] = plane_points[index].homogeneous().normalized();
      sample[k] = points[index];
    }
    const geometry::P3pSolutions solutions = geometry::SolveP3p(rays, sample);
    for (const Rigid3& pose : solutions.poses()) {
      const double cost = RobustCost(plane_points, points, pose, threshold * threshold, best_cost);
      if (cost < best_cost) {
        best_cost = cost;
        best = pose;
        // The cost gives a lower bound for the share of inliers.
        const double share = std::max(1.0 - cost / all_outliers, 1e-3);
        constexpr double kLogOfFailure = -9.2;  // ln 0.0001
        needed = kLogOfFailure / std::log1p(-std::min(share * share * share, 0.999));
      }
    }
  }
  return best;
}

std::vector<uint32_t> Inliers(const CameraModel& camera,
                              std::span<const Eigen::Vector2d> pixels,
                              std::span<const Eigen::Vector3d> points,
                              const Rigid3& camera_from_map,
                              double max_error_px) {
  std::vector<uint32_t> inliers;
  for (uint32_t i = 0; i < pixels.size(); ++i) {
    const std::optional<Eigen::Vector2d> projected = camera.Project(camera_from_map * points[i]);
    if (projected && (*projected - pixels[i]).norm() <= max_error_px) {
      inliers.push_back(i);
    }
  }
  return inliers;
}

// Adjusts a pose to its inliers, and the lens if `adjusted` says so, then decides whether enough
// correspondences agree with it.
std::optional<LensResection> Refine(const TrainingCamera& camera,
                                    std::span<const Eigen::Vector2d> pixels,
                                    std::span<const Eigen::Vector3d> points,
                                    const Rigid3& camera_from_map,
                                    const BundleOptions& adjusted,
                                    const ResectionOptions& options) {
  PosedView view{camera_from_map, camera.model};
  constexpr int kRefinements = 2;  // The second one uses the inliers of the first result.
  for (int i = 0; i < kRefinements; ++i) {
    std::vector<Eigen::Vector2d> inlier_pixels;
    std::vector<Eigen::Vector3d> inlier_points;
    for (const uint32_t index :
         Inliers(view.camera, pixels, points, view.camera_from_map, options.max_error_px)) {
      inlier_pixels.push_back(pixels[index]);
      inlier_points.push_back(points[index]);
    }
    if (inlier_pixels.size() < options.min_inliers) {
      return std::nullopt;
    }
    TrainingCamera start = camera;
    start.model = view.camera;
    const std::optional<PosedView> better =
        AdjustView(start, inlier_pixels, inlier_points, view.camera_from_map, adjusted);
    if (!better) {
      return std::nullopt;
    }
    view = *better;
  }
  LensResection found{{view.camera_from_map, Inliers(view.camera, pixels, points,
                                                     view.camera_from_map, options.max_error_px)},
                      view.camera};
  const size_t inliers = found.resection.inliers.size();
  const double share = static_cast<double>(inliers) / static_cast<double>(pixels.size());
  if (inliers < options.min_inliers || share < options.min_inlier_share) {
    return std::nullopt;
  }
  return found;
}

}  // namespace

std::optional<Resection> LocateImage(const CameraModel& camera,
                                     std::span<const Eigen::Vector2d> pixels,
                                     std::span<const Eigen::Vector3d> points,
                                     const ResectionOptions& options) {
  const std::optional<Rigid3> pose = EstimateByRansac(camera, pixels, points, options);
  std::optional<LensResection> found =
      pose ? Refine({camera}, pixels, points, *pose, BundleOptions(), options) : std::nullopt;
  return found ? std::optional(std::move(found->resection)) : std::nullopt;
}

std::optional<LensResection> LocateImageAndLens(const TrainingCamera& guess,
                                                std::span<const Eigen::Vector2d> pixels,
                                                std::span<const Eigen::Vector3d> points,
                                                const ResectionOptions& options) {
  constexpr int kSteps = 16;
  constexpr double kRange = 2.5;
  // A pose that makes up for the nearest focal length of the grid leaves larger errors.
  ResectionOptions coarse = options;
  coarse.max_error_px *= 2.0;
  TrainingCamera best_camera;
  std::optional<Rigid3> best;
  size_t most = 0;
  for (int step = 0; step <= kSteps; ++step) {
    TrainingCamera camera = guess;
    const double factor = std::pow(kRange, 2.0 * step / kSteps - 1.0);
    camera.model.fx *= factor;
    camera.model.fy *= factor;
    const std::optional<Rigid3> pose = EstimateByRansac(camera.model, pixels, points, coarse);
    const size_t inliers =
        pose ? Inliers(camera.model, pixels, points, *pose, options.max_error_px).size() : 0;
    if (inliers > most) {
      most = inliers;
      best = pose;
      best_camera = camera;
    }
  }
  BundleOptions adjusted;
  adjusted.refine_intrinsics = true;
  return best ? Refine(best_camera, pixels, points, *best, adjusted, options) : std::nullopt;
}

}  // namespace lararium::train
