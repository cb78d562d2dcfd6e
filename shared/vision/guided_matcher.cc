#include "shared/vision/guided_matcher.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr uint32_t kClusterSize = 64;         // Maximum number of points.
constexpr float kSideMargin = 1.001f;         // Factor on the radius, against rounding errors.
constexpr float kLeastFacing = 0.1f;          // Minimum cosine between normal and viewing ray.
constexpr float kLargestScaleRatio = 1.6f;    // Between observed and expected scale, either way.
constexpr uint32_t kLargestDistance = 60000;  // Squared distance of descriptors of length 512.

bool Faces(const Eigen::Vector3f& point,
           const Eigen::Vector3f& normal,
           const Eigen::Vector3f& camera_in_map) {
  const Eigen::Vector3f towards = camera_in_map - point;
  return normal.dot(towards) > kLeastFacing * towards.norm();
}

// [points]: Geometric mean over the observations of a point of keypoint scale times depth over
// focal length, in map units; 0 without observations.
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

GuidedMatcher::GuidedMatcher(const SceneDatabase& database) : database_(database) {
  BuildClusters();
}

// Splits the points at the median along their longest extent, until each part is small enough.
void GuidedMatcher::BuildClusters() {
  const auto& points = database_.points;
  const std::vector<float> scales = PointScales(database_);
  std::vector<uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::span<uint32_t>> open = {order};
  candidates_.reserve(points.size());
  while (!open.empty()) {
    const std::span<uint32_t> part = open.back();
    open.pop_back();
    if (part.size() <= kClusterSize) {
      AddCluster(part, scales);
      continue;
    }
    Eigen::AlignedBox3f box;
    for (const uint32_t point : part) {
      box.extend(points[point]);
    }
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const size_t middle = part.size() / 2;
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(middle), part.end(),
                     [&](uint32_t a, uint32_t b) {
                       const float x = points[a][axis];
                       const float y = points[b][axis];
                       return x != y ? x < y : a < b;
                     });
    open.push_back(part.subspan(middle));
    open.push_back(part.first(middle));
  }
}

void GuidedMatcher::AddCluster(std::span<const uint32_t> points, std::span<const float> scales) {
  Cluster cluster;
  Eigen::AlignedBox3f box;
  cluster.begin = static_cast<uint32_t>(candidates_.size());
  for (const uint32_t point : points) {
    box.extend(database_.points[point]);
    const float scale = scales[point];
    cluster.largest_scale = std::max(cluster.largest_scale,
                                     scale > 0.0f ? scale : std::numeric_limits<float>::infinity());
    candidates_.push_back({database_.points[point], database_.normals[point], scale, point});
  }
  cluster.end = static_cast<uint32_t>(candidates_.size());
  cluster.centre = box.center();
  cluster.radius = 0.5f * box.diagonal().norm();
  clusters_.push_back(cluster);
}

// Lens distortion bends the sides of the image; the planes go through their outermost pixels.
void GuidedMatcher::FillSides(const CameraModel& camera) {
  constexpr int kSteps = 8;
  Eigen::AlignedBox2d box;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = static_cast<double>(i) * camera.width / kSteps - 0.5;
    const double y = static_cast<double>(i) * camera.height / kSteps - 0.5;
    box.extend(camera.PlaneFromPixel({x, -0.5}));
    box.extend(camera.PlaneFromPixel({x, camera.height - 0.5}));
    box.extend(camera.PlaneFromPixel({-0.5, y}));
    box.extend(camera.PlaneFromPixel({camera.width - 0.5, y}));
  }
  const Eigen::Vector2f low = box.min().cast<float>();
  const Eigen::Vector2f high = box.max().cast<float>();
  sides_ = {Eigen::Vector3f(1.0f, 0.0f, -low.x()).normalized(),
            Eigen::Vector3f(-1.0f, 0.0f, high.x()).normalized(),
            Eigen::Vector3f(0.0f, 1.0f, -low.y()).normalized(),
            Eigen::Vector3f(0.0f, -1.0f, high.y()).normalized()};
}

bool GuidedMatcher::MayShow(const Cluster& cluster, const Eigen::Vector3f& centre) const {
  const float nearest = centre.z() - cluster.radius;
  if (centre.z() + cluster.radius <= 0.0f ||
      (nearest > 0.0f &&
       cluster.largest_scale * focal_ * kLargestScaleRatio < least_scale_ * nearest)) {
    return false;
  }
  return std::all_of(sides_.begin(), sides_.end(), [&](const Eigen::Vector3f& side) {
    return side.dot(centre) > -kSideMargin * cluster.radius;
  });
}

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
  FillSides(camera);
  focal_ = static_cast<float>(camera.Focal());
  least_scale_ = std::numeric_limits<float>::infinity();
  for (const Keypoint& keypoint : features.keypoints) {
    least_scale_ = std::min(least_scale_, keypoint.scale);
  }
  best_of_feature_.assign(features.size(), {kNone, 0, kNone});
  searched_ = {0, 0};
  const Eigen::Matrix3f rotation = camera_from_map.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = camera_from_map.translation.cast<float>();
  const Eigen::Vector3f camera_in_map = camera_from_map.Center().cast<float>();
  for (const Cluster& cluster : clusters_) {
    if (!MayShow(cluster, rotation * cluster.centre + translation)) {
      continue;
    }
    for (uint32_t i = cluster.begin; i < cluster.end; ++i) {
      const Candidate& candidate = candidates_[i];
      const Eigen::Vector3f p = rotation * candidate.position + translation;
      if (p.z() <= 1e-6f || !Faces(candidate.position, candidate.normal, camera_in_map)) {
        continue;
      }
      const float expected_scale = candidate.scale * focal_ / p.z();
      if (expected_scale > 0.0f && expected_scale * kLargestScaleRatio < least_scale_) {
        continue;
      }
      const auto pixel = camera.Project(p.cast<double>());
      if (!pixel || !camera.Contains(*pixel)) {
        continue;
      }
      ++searched_[database_.HasLookalike(candidate.point) ? 1 : 0];
      const FeatureMatch match = BestNear(candidate.point, pixel->cast<float>(), expected_scale,
                                          static_cast<float>(radius_px), features);
      if (match.feature == kNone) {
        continue;
      }
      FeatureMatch& best = best_of_feature_[match.feature];
      // Of two equally similar points, the one with the lower index wins, independent of the order
      // of the clusters.
      if (match.squared_distance < best.squared_distance ||
          (match.squared_distance == best.squared_distance && match.point < best.point)) {
        best = match;
      }
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
