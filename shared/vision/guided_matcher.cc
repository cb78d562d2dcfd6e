#include "shared/vision/guided_matcher.h"

#include <algorithm>
#include <cmath>

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr float kLeastFacing = 0.1f;          // cosine between normal and line of sight
constexpr float kLargestScaleRatio = 1.6f;    // seen over expected
constexpr uint32_t kLargestDistance = 60000;  // squared, of descriptors of length 512

// Geometric mean over its sights, of keypoint scale times depth over focal length.
std::vector<float> PointScales(const SceneDatabase& db) {
  std::vector<double> log_sums(db.points.size(), 0.0);
  std::vector<int> counts(db.points.size(), 0);
  for (const Observation& o : db.observations) {
    const Eigen::Vector3d p =
        db.keyframes[o.keyframe].camera_from_map * db.points[o.point].cast<double>();
    if (p.z() > 0.0) {
      log_sums[o.point] += std::log(o.scale * p.z() / db.camera.Focal());
      ++counts[o.point];
    }
  }
  std::vector<float> scales(db.points.size(), 0.0f);
  for (size_t i = 0; i < scales.size(); ++i) {
    if (counts[i] > 0) {
      scales[i] = static_cast<float>(std::exp(log_sums[i] / counts[i]));
    }
  }
  return scales;
}

}  // namespace

GuidedMatcher::GuidedMatcher(const SceneDatabase& database)
    : database_(database), point_scales_(PointScales(database)) {}

void GuidedMatcher::FillGrid(const CameraModel& camera, const Features& features) {
  columns_ = camera.width / kCell + 1;
  rows_ = camera.height / kCell + 1;
  first_.assign(static_cast<size_t>(columns_) * rows_, kNone);
  next_.assign(features.size(), kNone);
  for (size_t f = 0; f < features.size(); ++f) {
    const int column =
        std::clamp(static_cast<int>(features.keypoints[f].x / kCell), 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(features.keypoints[f].y / kCell), 0, rows_ - 1);
    uint32_t& head = first_[row * columns_ + column];
    next_[f] = head;
    head = static_cast<uint32_t>(f);
  }
}

bool GuidedMatcher::Faces(size_t point, const Eigen::Vector3f& camera_in_map) const {
  const Eigen::Vector3f towards = camera_in_map - database_.points[point];
  return database_.normals[point].dot(towards) > kLeastFacing * towards.norm();
}

uint32_t GuidedMatcher::Distance(size_t point, const Descriptor& descriptor) const {
  uint32_t least = kNone;
  for (uint32_t d = database_.descriptor_begin[point]; d < database_.descriptor_begin[point + 1];
       ++d) {
    least = std::min(least, SquaredDistance(descriptor, database_.descriptors[d]));
  }
  return least;
}

FeatureMatch GuidedMatcher::BestNear(size_t point,
                                     const Eigen::Vector2f& pixel,
                                     float expected_scale,
                                     float radius_px,
                                     const Features& features) const {
  FeatureMatch best{kNone, static_cast<uint32_t>(point), kLargestDistance};
  const auto cell = [](float pixels, int count) {
    return std::clamp(static_cast<int>(pixels / kCell), 0, count - 1);
  };
  for (int row = cell(pixel.y() - radius_px, rows_); row <= cell(pixel.y() + radius_px, rows_);
       ++row) {
    for (int column = cell(pixel.x() - radius_px, columns_);
         column <= cell(pixel.x() + radius_px, columns_); ++column) {
      for (uint32_t f = first_[row * columns_ + column]; f != kNone; f = next_[f]) {
        const Keypoint& k = features.keypoints[f];
        const float dx = k.x - pixel.x();
        const float dy = k.y - pixel.y();
        const bool near = dx * dx + dy * dy < radius_px * radius_px;
        const bool similar =
            expected_scale <= 0.0f || (k.scale < kLargestScaleRatio * expected_scale &&
                                       k.scale * kLargestScaleRatio > expected_scale);
        if (!near || !similar) {
          continue;
        }
        const uint32_t distance = Distance(point, features.descriptors[f]);
        if (distance < best.squared_distance) {
          best.feature = f;
          best.squared_distance = distance;
        }
      }
    }
  }
  return best;
}

void GuidedMatcher::Match(const CameraModel& camera,
                          const Rigid3& camera_from_map,
                          const Features& features,
                          double radius_px,
                          std::vector<FeatureMatch>& matches) {
  FillGrid(camera, features);
  best_of_feature_.assign(features.size(), {kNone, 0, kNone});
  const Eigen::Matrix3f rotation = camera_from_map.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = camera_from_map.translation.cast<float>();
  const Eigen::Vector3f camera_in_map = camera_from_map.Center().cast<float>();
  for (size_t point = 0; point < database_.points.size(); ++point) {
    const Eigen::Vector3f p = rotation * database_.points[point] + translation;
    if (p.z() <= 1e-6f || !Faces(point, camera_in_map)) {
      continue;
    }
    const auto pixel = camera.Project(p.cast<double>());
    if (!pixel || !camera.Contains(*pixel)) {
      continue;
    }
    const float expected_scale = point_scales_[point] * static_cast<float>(camera.Focal()) / p.z();
    const FeatureMatch match = BestNear(point, pixel->cast<float>(), expected_scale,
                                        static_cast<float>(radius_px), features);
    if (match.feature != kNone &&
        match.squared_distance < best_of_feature_[match.feature].squared_distance) {
      best_of_feature_[match.feature] = match;
    }
  }
  matches.clear();
  for (const FeatureMatch& match : best_of_feature_) {
    if (match.feature != kNone) {
      matches.push_back(match);
    }
  }
}

}  // namespace lararium::vision
