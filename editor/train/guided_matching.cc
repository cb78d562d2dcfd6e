#include "editor/train/guided_matching.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "shared/vision/descriptor_forest.h"
#include "shared/vision/lanes.h"

namespace lararium::train {
namespace {

using vision::IntegerLanes;
using vision::kLanes;
using vision::Lanes;
using vision::LoadLanes;
using vision::StoreLanes;

constexpr double kPerCell = 3.0;  // Mean number of features per cell.
// Cosine of the largest difference from GuidedOptions::turn, 0.8 radians.
constexpr float kMaxTurnCosine = 0.696707f;
constexpr float kMaxGrowth = 1.0f;  // Largest difference from GuidedOptions::growth, octaves.
// Largest squared distance of a match; descriptors have length 512. With so few candidates, the
// ratio test alone would accept random matches.
constexpr uint32_t kFarthest = 270 * 270;

struct NearestCandidate {
  uint32_t best = std::numeric_limits<uint32_t>::max();
  uint32_t second = std::numeric_limits<uint32_t>::max();
  uint32_t position = 0;

  void Add(uint32_t squared_distance, size_t candidate) {
    if (squared_distance < best) {
      second = best;
      best = squared_distance;
      position = static_cast<uint32_t>(candidate);
    } else if (squared_distance < second) {
      second = squared_distance;
    }
  }
  bool Distinct(float squared_ratio) const {
    return best <= kFarthest &&
           static_cast<float>(best) < squared_ratio * static_cast<float>(second);
  }
};

}  // namespace

FeatureGrid::FeatureGrid(const vision::Features& features, std::span<const Eigen::Vector2d> points)
    : descriptors_(features.descriptors) {
  if (points.empty()) {
    return;
  }
  Eigen::Vector2d low = points.front();
  Eigen::Vector2d high = points.front();
  for (const Eigen::Vector2d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector2d extent = (high - low).cwiseMax(1e-9);
  corner_ = low;
  // Limits the number of cells for long thin point clouds.
  cell_ = std::max(std::sqrt(extent.prod() * kPerCell / static_cast<double>(points.size())),
                   extent.maxCoeff() / 1000.0);
  columns_ = static_cast<int>(extent.x() / cell_) + 1;
  rows_ = static_cast<int>(extent.y() / cell_) + 1;
  std::vector<uint32_t> cell_of(points.size());
  begin_.assign(static_cast<size_t>(columns_) * rows_ + 1, 0);
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d at = (points[i] - corner_) / cell_;
    cell_of[i] =
        static_cast<uint32_t>(static_cast<int>(at.y()) * columns_ + static_cast<int>(at.x()));
    ++begin_[cell_of[i] + 1];
  }
  for (size_t cell = 1; cell < begin_.size(); ++cell) {
    begin_[cell] += begin_[cell - 1];
  }
  index_.resize(points.size());
  std::vector<uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (uint32_t i = 0; i < points.size(); ++i) {
    index_[next[cell_of[i]]++] = i;
  }
  for (std::vector<float>* values : {&x_, &y_, &angle_, &cosine_, &sine_, &log_scale_}) {
    values->resize(index_.size() + kLanes);
  }
  for (size_t position = 0; position < index_.size(); ++position) {
    const uint32_t i = index_[position];
    const vision::Keypoint& keypoint = features.keypoints[i];
    x_[position] = static_cast<float>(points[i].x());
    y_[position] = static_cast<float>(points[i].y());
    angle_[position] = keypoint.angle;
    cosine_[position] = std::cos(keypoint.angle);
    sine_[position] = std::sin(keypoint.angle);
    log_scale_[position] = std::log2(keypoint.scale);
  }
}

template <typename Visit>
void FeatureGrid::VisitSimilar(
    const Eigen::Vector3d& line, double band, float angle, float log_scale, Visit visit) const {
  const double nx = line.x();
  const double ny = line.y();
  const double d = line.z();
  // Goes row by row if the line is steep, otherwise column by column, so that each step visits few
  // cells.
  const Eigen::Vector3f normal = line.cast<float>();
  const float squared_band = static_cast<float>(band * band);
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  const auto visit_cells = [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; i += kLanes) {
      const Lanes off =
          normal.x() * LoadLanes(&x_[i]) + normal.y() * LoadLanes(&y_[i]) + normal.z();
      const Lanes turn = cosine * LoadLanes(&cosine_[i]) + sine * LoadLanes(&sine_[i]);
      const Lanes growth = LoadLanes(&log_scale_[i]) - log_scale;
      const IntegerLanes similar = (off * off < squared_band) & (turn >= kMaxTurnCosine) &
                                   (growth * growth <= kMaxGrowth * kMaxGrowth);
      std::array<int32_t, kLanes> is_similar;
      StoreLanes(similar, is_similar.data());
      for (size_t lane = 0; lane < std::min<size_t>(kLanes, end - i); ++lane) {
        if (is_similar[lane] != 0) {
          visit(i + lane);
        }
      }
    }
  };
  if (std::abs(nx) > std::abs(ny)) {
    for (int row = 0; row < rows_; ++row) {
      const double top = corner_.y() + row * cell_;
      const double x0 = -(ny * top + d) / nx;
      const double x1 = -(ny * (top + cell_) + d) / nx;
      const double margin = band / std::abs(nx);
      const double first = (std::min(x0, x1) - margin - corner_.x()) / cell_;
      const double last = (std::max(x0, x1) + margin - corner_.x()) / cell_;
      if (last < 0.0 || first >= columns_) {
        continue;
      }
      const int from = std::max(0, static_cast<int>(first));
      const int to = last >= columns_ ? columns_ - 1 : static_cast<int>(last);
      const size_t base = static_cast<size_t>(row) * columns_;
      visit_cells(begin_[base + from], begin_[base + to + 1]);
    }
  } else {
    for (int column = 0; column < columns_; ++column) {
      const double left = corner_.x() + column * cell_;
      const double y0 = -(nx * left + d) / ny;
      const double y1 = -(nx * (left + cell_) + d) / ny;
      const double margin = band / std::abs(ny);
      const double first = (std::min(y0, y1) - margin - corner_.y()) / cell_;
      const double last = (std::max(y0, y1) + margin - corner_.y()) / cell_;
      if (last < 0.0 || first >= rows_) {
        continue;
      }
      const int to = last >= rows_ ? rows_ - 1 : static_cast<int>(last);
      for (int row = std::max(0, static_cast<int>(first)); row <= to; ++row) {
        const size_t cell = static_cast<size_t>(row) * columns_ + column;
        visit_cells(begin_[cell], begin_[cell + 1]);
      }
    }
  }
}

std::vector<FeatureMatch> MatchGuided(const FeatureGrid& a,
                                      const FeatureGrid& b,
                                      const GuidedOptions& options) {
  std::vector<NearestCandidate> of_a(a.size());
  std::vector<NearestCandidate> of_b(b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    Eigen::Vector3d line = options.fundamental * a.point(i).homogeneous();
    const double length = line.head<2>().norm();
    if (!(length > 1e-12)) {
      continue;  // The point is the epipole, which has no line.
    }
    line /= length;
    const auto compare = [&](size_t j) {
      const uint32_t squared_distance = vision::SquaredDistance(a.descriptor(i), b.descriptor(j));
      of_a[i].Add(squared_distance, j);
      of_b[j].Add(squared_distance, i);
    };
    b.VisitSimilar(line, options.band, a.angle(i) + options.turn, a.log_scale(i) + options.growth,
                   compare);
  }
  const float squared_ratio = options.ratio * options.ratio;
  std::vector<FeatureMatch> matches;
  for (size_t i = 0; i < a.size(); ++i) {
    const NearestCandidate& forward = of_a[i];
    if (forward.Distinct(squared_ratio) && of_b[forward.position].position == i &&
        of_b[forward.position].Distinct(squared_ratio)) {
      matches.push_back({a.index(i), b.index(forward.position)});
    }
  }
  std::sort(matches.begin(), matches.end(),
            [](const FeatureMatch& p, const FeatureMatch& q) { return p.a < q.a; });
  return matches;
}

void MeasureTurnAndGrowth(const vision::Features& a,
                          const vision::Features& b,
                          std::span<const FeatureMatch> matches,
                          GuidedOptions& options) {
  float sine = 0.0f;
  float cosine = 0.0f;
  std::vector<float> growths;
  for (const FeatureMatch& match : matches) {
    const vision::Keypoint& in_a = a.keypoints[match.a];
    const vision::Keypoint& in_b = b.keypoints[match.b];
    sine += std::sin(in_b.angle - in_a.angle);
    cosine += std::cos(in_b.angle - in_a.angle);
    growths.push_back(std::log2(in_b.scale / in_a.scale));
  }
  options.turn = std::atan2(sine, cosine);
  if (!growths.empty()) {
    const auto middle = growths.begin() + static_cast<ptrdiff_t>(growths.size() / 2);
    std::nth_element(growths.begin(), middle, growths.end());
    options.growth = *middle;
  }
}

}  // namespace lararium::train
