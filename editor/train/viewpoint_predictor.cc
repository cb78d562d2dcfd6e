#include "editor/train/viewpoint_predictor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shared/core/median.h"
#include "shared/vision/pose_refinement.h"

namespace lararium::train {
namespace {

using geometry::Rigid3;

constexpr size_t kMaxPredictedPoints = 8000;
// A SIFT feature is matched up to about this difference in angle (radians) and in distance (factor)
// from the views in training.
constexpr double kMoreAngle = 25.0 * std::numbers::pi / 180.0;
constexpr double kMoreDistance = 1.8;
// With fewer matches the localizer rarely gives a pose.
constexpr double kMinMatches = 15.0;

}  // namespace

ViewpointQuality QualityOf(const ViewpointPrediction& prediction) {
  if (prediction.matches < kMinMatches) {
    return ViewpointQuality::kNone;
  }
  if (prediction.matches < 40.0 || !(prediction.error_px < 1.5)) {
    return ViewpointQuality::kPoor;
  }
  return prediction.matches < 100.0 || prediction.error_px > 0.5 ? ViewpointQuality::kFair
                                                                 : ViewpointQuality::kGood;
}

ViewpointPredictor::ViewpointPredictor(const vision::SceneDatabase& database)
    : camera_(database.camera) {
  const size_t stride =
      std::max<size_t>(1, (database.points.size() + kMaxPredictedPoints - 1) / kMaxPredictedPoints);
  points_each_ = static_cast<double>(stride);
  for (size_t i = 0; i < database.points.size(); i += stride) {
    Point& point = points_.emplace_back();
    point.position = database.points[i].cast<double>();
    point.normal = database.normals[i].cast<double>();
    point.nearest = std::numeric_limits<double>::infinity();
  }
  std::vector<double> depths;
  for (const vision::Observation& o : database.observations) {
    if (o.point % stride != 0) {
      continue;
    }
    Point& point = points_[o.point / stride];
    const Rigid3& pose = database.keyframes[o.keyframe].camera_from_map;
    const Eigen::Vector3d towards = pose.Center() - point.position;
    const double distance = towards.norm();
    if (distance > 0.0) {
      point.min_cosine = std::min(point.min_cosine, point.normal.dot(towards) / distance);
    }
    point.nearest = std::min(point.nearest, distance);
    point.farthest = std::max(point.farthest, distance);
    depths.push_back((pose * point.position).z());
  }
  median_depth_ = Median(depths);
  for (Point& point : points_) {
    const double angle = std::acos(std::clamp(point.min_cosine, -1.0, 1.0)) + kMoreAngle;
    point.min_cosine = std::cos(std::min(angle, std::numbers::pi));
    point.nearest /= kMoreDistance;
    point.farthest *= kMoreDistance;
  }
  MeasureKeyframes(database, stride);
}

void ViewpointPredictor::MeasureKeyframes(const vision::SceneDatabase& database, size_t stride) {
  std::vector<double> seen(database.keyframes.size(), 0.0);
  std::vector<double> errors;
  for (const vision::Observation& o : database.observations) {
    if (o.point % stride == 0) {
      seen[o.keyframe] += 1.0;
      const auto pixel = camera_.Project(database.keyframes[o.keyframe].camera_from_map *
                                         points_[o.point / stride].position);
      if (pixel) {
        errors.push_back((*pixel - Eigen::Vector2d(o.x, o.y)).norm());
      }
    }
  }
  // The median length of a two-dimensional normal residual is 1.177 times its sigma along one axis.
  noise_px_ = std::max(Median(errors) / 1.177, 0.05);
  std::vector<double> shares;
  std::vector<uint32_t> visible;
  for (size_t k = 0; k < database.keyframes.size(); ++k) {
    FillVisible(database.keyframes[k].camera_from_map, visible);
    if (!visible.empty()) {
      shares.push_back(std::min(1.0, seen[k] / static_cast<double>(visible.size())));
    }
  }
  found_share_ = shares.empty() ? 1.0 : Median(shares);
}

void ViewpointPredictor::FillVisible(const Rigid3& camera_from_map,
                                     std::vector<uint32_t>& visible) const {
  visible.clear();
  const Eigen::Vector3d center = camera_from_map.Center();
  for (uint32_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    const Eigen::Vector3d towards = center - point.position;
    const double distance = towards.norm();
    if (distance < point.nearest || distance > point.farthest ||
        point.normal.dot(towards) < point.min_cosine * distance) {
      continue;
    }
    const auto pixel = camera_.Project(camera_from_map * point.position);
    if (pixel && camera_.Contains(*pixel)) {
      visible.push_back(i);
    }
  }
}

ViewpointPrediction ViewpointPredictor::Predict(const Rigid3& camera_from_map) const {
  std::vector<uint32_t> visible;
  FillVisible(camera_from_map, visible);
  ViewpointPrediction prediction;
  const double each = points_each_ * found_share_;
  prediction.matches = each * static_cast<double>(visible.size());
  prediction.error_px = std::numeric_limits<double>::infinity();
  if (prediction.matches < kMinMatches || visible.size() < 3) {
    return prediction;
  }
  const double focal = camera_.Focal();
  const double weight = each * focal * focal / (noise_px_ * noise_px_);
  vision::Matrix6d information = vision::Matrix6d::Zero();
  std::vector<double> depths;
  for (const uint32_t i : visible) {
    const vision::PoseMatch match{points_[i].position, Eigen::Vector2d::Zero()};
    Eigen::Vector2d residual;
    vision::Matrix26d jacobian;
    if (vision::PlaneResidual(camera_from_map, match, residual, &jacobian)) {
      information.noalias() += weight * jacobian.transpose() * jacobian;
      depths.push_back((camera_from_map * points_[i].position).z());
    }
  }
  const Eigen::LDLT<vision::Matrix6d> solver(information);
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0.0)) {
    return prediction;
  }
  const double depth = Median(depths);
  double largest = 0.0;
  for (const double x : {0.0, camera_.width - 1.0}) {
    for (const double y : {0.0, camera_.height - 1.0}) {
      vision::PoseMatch corner;
      corner.plane = camera_.PlaneFromPixel({x, y});
      corner.point = camera_from_map.Inverse() * (depth * corner.plane.homogeneous());
      Eigen::Vector2d residual;
      vision::Matrix26d jacobian;
      if (vision::PlaneResidual(camera_from_map, corner, residual, &jacobian)) {
        const Eigen::Matrix2d covariance =
            jacobian * solver.solve(vision::Matrix6d::Identity()) * jacobian.transpose();
        largest = std::max(largest, covariance.trace());
      }
    }
  }
  prediction.error_px = focal * std::sqrt(largest);
  return prediction;
}

}  // namespace lararium::train
