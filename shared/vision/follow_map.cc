#include "shared/vision/follow_map.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "shared/core/parallel.h"

namespace lararium::vision {

using geometry::Rigid3;

int CoarsestLevel(int width) {
  constexpr double kWidth = 80.0;
  return std::clamp(static_cast<int>(std::lround(std::log2(width / kWidth))), 1, 8);
}

TrackedMap::TrackedMap(std::shared_ptr<const SceneDatabase> database)
    : database_(std::move(database)),
      pyramids_(database_->keyframes.size()),
      point_begin_(database_->points.size() + 1, 0),
      keyframe_begin_(database_->keyframes.size() + 1, 0),
      median_depths_(database_->keyframes.size(), 0.0),
      cell_begin_(database_->keyframes.size() * (kCells + 1), 0),
      by_cell_(database_->observations.size()),
      depths_(database_->observations.size()) {
  const SceneDatabase& db = *database_;
  for (const Observation& o : db.observations) {
    ++keyframe_begin_[o.keyframe + 1];
    if (!db.keyframes[o.keyframe].grey.empty()) {
      ++point_begin_[o.point + 1];
    }
  }
  for (size_t k = 0; k < db.keyframes.size(); ++k) {
    keyframe_begin_[k + 1] += keyframe_begin_[k];
  }
  for (size_t p = 0; p < db.points.size(); ++p) {
    point_begin_[p + 1] += point_begin_[p];
  }
  point_keyframes_.resize(point_begin_.back());
  std::vector<uint32_t> next(point_begin_.begin(), point_begin_.end() - 1);
  for (const Observation& o : db.observations) {
    if (!db.keyframes[o.keyframe].grey.empty()) {
      point_keyframes_[next[o.point]++] = o.keyframe;
    }
  }
  ParallelFor(db.keyframes.size(), [&](size_t k) {
    const cv::Mat& grey = db.keyframes[k].grey;
    if (!grey.empty()) {
      pyramids_[k].Build(grey, CoarsestLevel(grey.cols) + 1);
    }
    FillGrid(static_cast<uint32_t>(k));
  });
}

std::span<const uint32_t> TrackedMap::KeyframesOf(uint32_t point) const {
  return {point_keyframes_.data() + point_begin_[point],
          point_begin_[point + 1] - point_begin_[point]};
}

std::span<const Observation> TrackedMap::ObservationsIn(uint32_t keyframe) const {
  return {database_->observations.data() + keyframe_begin_[keyframe],
          keyframe_begin_[keyframe + 1] - keyframe_begin_[keyframe]};
}

int TrackedMap::CellOf(double x, double y) const {
  const int column =
      std::clamp(static_cast<int>(x * kColumns / database_->camera.width), 0, kColumns - 1);
  const int row = std::clamp(static_cast<int>(y * kRows / database_->camera.height), 0, kRows - 1);
  return row * kColumns + column;
}

void TrackedMap::FillGrid(uint32_t keyframe) {
  const Rigid3& camera_from_map = database_->keyframes[keyframe].camera_from_map;
  const uint32_t first = keyframe_begin_[keyframe];
  const auto observations = ObservationsIn(keyframe);
  uint32_t* begin = cell_begin_.data() + static_cast<size_t>(keyframe) * (kCells + 1);
  std::vector<float> depths;
  for (size_t i = 0; i < observations.size(); ++i) {
    const Observation& o = observations[i];
    const auto depth =
        static_cast<float>((camera_from_map * database_->points[o.point].cast<double>()).z());
    depths_[first + i] = depth;
    depths.push_back(depth);
    ++begin[CellOf(o.x, o.y) + 1];
  }
  begin[0] = first;
  for (int c = 0; c < kCells; ++c) {
    begin[c + 1] += begin[c];
  }
  std::vector<uint32_t> next(begin, begin + kCells);
  for (size_t i = 0; i < observations.size(); ++i) {
    by_cell_[next[CellOf(observations[i].x, observations[i].y)]++] =
        static_cast<uint32_t>(first + i);
  }
  if (!depths.empty()) {
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    median_depths_[keyframe] = *middle;
  }
}

Eigen::Vector3d TrackedMap::PlaneAt(uint32_t keyframe, uint32_t point) const {
  // A plane's inverse depth is affine in the image: 1/z = n . (x, y, 1).
  const SceneDatabase& db = *database_;
  const Eigen::Vector3d p =
      db.keyframes[keyframe].camera_from_map * db.points[point].cast<double>();
  const double focal = db.camera.Focal();
  const Eigen::Vector2d plane = p.hnormalized();
  const Eigen::Vector2d pixel = db.PixelIn(keyframe, db.points[point].cast<double>())
                                    .value_or(db.camera.PixelFromPlane(plane));
  const double inverse = 1.0 / p.z();

  struct Neighbour {
    Eigen::Vector2d offset;  // Image distance from the point, in focal lengths.
    double rise;             // Relative change of the inverse depth.
    double near;             // Weight by image distance.
  };
  constexpr size_t kMost = 64;
  std::array<Neighbour, kMost> neighbours;
  size_t count = 0;
  const double width = static_cast<double>(db.camera.width) / kColumns;
  const double height = static_cast<double>(db.camera.height) / kRows;
  const double reach2 = width * width;
  const uint32_t* begin = cell_begin_.data() + static_cast<size_t>(keyframe) * (kCells + 1);
  const int left = CellOf(pixel.x() - width, 0.0);
  const int right = CellOf(pixel.x() + width, 0.0);
  const int top = CellOf(0.0, pixel.y() - height) / kColumns;
  const int bottom = CellOf(0.0, pixel.y() + height) / kColumns;
  for (int row = top; row <= bottom; ++row) {
    for (uint32_t i = begin[row * kColumns + left]; i < begin[row * kColumns + right + 1]; ++i) {
      const Observation& o = db.observations[by_cell_[i]];
      const float depth = depths_[by_cell_[i]];
      const Eigen::Vector2d offset = Eigen::Vector2d(o.x, o.y) - pixel;
      if (o.point == point || depth <= 0.0f || count == kMost) {
        continue;
      }
      neighbours[count++] = {offset / focal, p.z() / depth - 1.0,
                             std::exp(-0.5 * offset.squaredNorm() / reach2)};
    }
  }
  // Robust to the depths of other surfaces: the scale narrows from that of a steep slope to that of
  // the noise. A weak prior pulls the plane towards facing the camera.
  constexpr std::array<double, 4> kScales = {0.15, 0.06, 0.03, 0.02};
  const double pull = 2.0 * std::pow(0.25 * width / focal, 2);
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (const double scale : kScales) {
    Eigen::Matrix2d matrix = pull * Eigen::Matrix2d::Identity();
    Eigen::Vector2d vector = Eigen::Vector2d::Zero();
    for (size_t i = 0; i < count; ++i) {
      const Neighbour& n = neighbours[i];
      const double residual = n.rise - slope.dot(n.offset);
      const double weight = n.near / (1.0 + std::pow(residual / scale, 2));
      matrix.noalias() += weight * n.offset * n.offset.transpose();
      vector.noalias() += weight * n.rise * n.offset;
    }
    slope = matrix.ldlt().solve(vector);
  }
  // A steeper surface would not be visible in the keyframe.
  constexpr double kSteepest = 6.0;  // Tangent of the slant.
  if (slope.norm() > kSteepest) {
    slope *= kSteepest / slope.norm();
  }
  return inverse * Eigen::Vector3d(slope.x(), slope.y(), 1.0 - slope.dot(plane));
}

}  // namespace lararium::vision
