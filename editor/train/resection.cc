#include "editor/train/resection.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "editor/train/bundle_adjustment.h"
#include "shared/core/check.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

std::optional<Rigid3> EstimateByRansac(const CameraModel& camera,
                                       std::span<const Eigen::Vector2d> pixels,
                                       std::span<const Eigen::Vector3d> points,
                                       double max_error_px) {
  std::vector<cv::Point2d> plane_points;
  std::vector<cv::Point3d> object_points;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const Eigen::Vector2d plane = camera.PlaneFromPixel(pixels[i]);
    plane_points.emplace_back(plane.x(), plane.y());
    object_points.emplace_back(points[i].x(), points[i].y(), points[i].z());
  }
  cv::Mat rotation_vector;
  cv::Mat translation;
  constexpr int kIterations = 2000;
  constexpr double kConfidence = 0.9999;
  try {
    if (!cv::solvePnPRansac(object_points, plane_points, cv::Mat::eye(3, 3, CV_64F), cv::noArray(),
                            rotation_vector, translation, false, kIterations,
                            static_cast<float>(max_error_px / camera.Focal()), kConfidence,
                            cv::noArray(), cv::SOLVEPNP_AP3P)) {
      return std::nullopt;
    }
  } catch (const cv::Exception&) {
    return std::nullopt;  // the sample had no solution
  }
  Eigen::Vector3d w;
  Eigen::Vector3d t;
  cv::cv2eigen(rotation_vector, w);
  cv::cv2eigen(translation, t);
  if (!w.allFinite() || !t.allFinite()) {
    return std::nullopt;
  }
  return Rigid3{geometry::RotationFromVector(w), t};
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

}  // namespace

std::optional<Resection> LocateImage(const CameraModel& camera,
                                     std::span<const Eigen::Vector2d> pixels,
                                     std::span<const Eigen::Vector3d> points,
                                     const ResectionOptions& options) {
  CHECK(pixels.size() == points.size());
  if (pixels.size() < options.min_inliers) {
    return std::nullopt;
  }
  std::optional<Rigid3> pose = EstimateByRansac(camera, pixels, points, options.max_error_px);
  constexpr int kRefinements = 2;  // the second with the inliers that the first brought in
  for (int i = 0; i < kRefinements && pose; ++i) {
    std::vector<Eigen::Vector2d> inlier_pixels;
    std::vector<Eigen::Vector3d> inlier_points;
    for (const uint32_t index : Inliers(camera, pixels, points, *pose, options.max_error_px)) {
      inlier_pixels.push_back(pixels[index]);
      inlier_points.push_back(points[index]);
    }
    if (inlier_pixels.size() < options.min_inliers) {
      return std::nullopt;
    }
    pose = AdjustPose(camera, inlier_pixels, inlier_points, *pose, BundleOptions());
  }
  if (!pose) {
    return std::nullopt;
  }
  Resection resection{*pose, Inliers(camera, pixels, points, *pose, options.max_error_px)};
  const double share =
      static_cast<double>(resection.inliers.size()) / static_cast<double>(pixels.size());
  if (resection.inliers.size() < options.min_inliers || share < options.min_inlier_share) {
    return std::nullopt;
  }
  return resection;
}

}  // namespace lararium::train
