#pragma once

// Guided matching of two images with a known two-view geometry: each feature is compared only with
// features near its epipolar line whose rotation and scale agree with those between the images.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "editor/train/matching.h"
#include "shared/vision/features.h"

namespace lararium::train {

// The features of an image, grouped by the cells of a grid; parallel arrays, cell by cell.
class FeatureGrid {
 public:
  // points[i] is the position of feature i, in pixels or undistorted on the plane z = 1. features
  // must outlive the grid.
  FeatureGrid(const vision::Features& features, std::span<const Eigen::Vector2d> points);

  size_t size() const { return index_.size(); }

  // Calls visit(position) for all features nearer than band to the line (n_x, n_y, d), where n has
  // length 1, whose rotation and scale are similar to these. `position` is an index into the grid's
  // arrays.
  template <typename Visit>
  void VisitSimilar(
      const Eigen::Vector3d& line, double band, float angle, float log_scale, Visit visit) const;

  Eigen::Vector2d point(size_t position) const { return {x_[position], y_[position]}; }
  float angle(size_t position) const { return angle_[position]; }
  float log_scale(size_t position) const { return log_scale_[position]; }
  uint32_t index(size_t position) const { return index_[position]; }
  const vision::Descriptor& descriptor(size_t position) const {
    return descriptors_[index_[position]];
  }

 private:
  int columns_ = 0;
  int rows_ = 0;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  double cell_ = 1.0;
  std::vector<uint32_t> begin_;  // [rows_ * columns_ + 1]: Ranges of positions per cell.
  std::vector<uint32_t> index_;  // Index of the feature.
  // These arrays are padded by one vector of numbers.
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> angle_;
  std::vector<float> cosine_;  // Cosine and sine of angle_.
  std::vector<float> sine_;
  std::vector<float> log_scale_;  // Logarithm to base 2.
  std::span<const vision::Descriptor> descriptors_;
};

struct GuidedOptions {
  Eigen::Matrix3d fundamental;  // F with b' F a = 0 for the grids' points.
  double band = 0.0;            // Largest distance from the epipolar line, unit of the points.
  float turn = 0.0f;            // Angle in b minus angle in a, radians.
  float growth = 0.0f;          // log2 of the scale in b over that in a.
  float ratio = 0.8f;           // Ratio test among the candidates; see MatchDescriptors.
};

// Pairs of features that are mutual nearest neighbours among the candidates. Ordered by a.
std::vector<FeatureMatch> MatchGuided(const FeatureGrid& a,
                                      const FeatureGrid& b,
                                      const GuidedOptions& options);

// Fills in options.turn and options.growth from matches: the mean turn and the median growth.
void MeasureTurnAndGrowth(const vision::Features& a,
                          const vision::Features& b,
                          std::span<const FeatureMatch> matches,
                          GuidedOptions& options);

}  // namespace lararium::train
