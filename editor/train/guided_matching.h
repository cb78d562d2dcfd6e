#pragma once

// Matches between two images whose two-view geometry is known: each feature is
// only compared with those near its epipolar line that are turned and scaled as
// the images are.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "editor/train/matching.h"
#include "shared/vision/features.h"

namespace lararium::train {

// The features of an image in cells of its plane; parallel arrays, cell by cell.
class FeatureGrid {
 public:
  // points: of the features, pixels or undistorted on the plane z = 1. Borrows
  // the descriptors.
  FeatureGrid(const vision::Features& features, std::span<const Eigen::Vector2d> points);

  size_t size() const { return index_.size(); }

  // Calls visit(position) for the positions of all features nearer than band to
  // the line (n_x, n_y, d), n of length 1.
  template <typename Visit>
  void VisitNearLine(const Eigen::Vector3d& line, double band, Visit visit) const;

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
  std::vector<uint32_t> begin_;  // [row * columns_ + column], and the end
  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<float> angle_;
  std::vector<float> log_scale_;  // to base 2
  std::vector<uint32_t> index_;   // of the feature
  std::span<const vision::Descriptor> descriptors_;
};

struct GuidedOptions {
  Eigen::Matrix3d fundamental;  // b' F a = 0 for the grids' points
  double band = 0.0;            // largest distance from the epipolar line, as the points
  float turn = 0.0f;            // radians, angle in b less angle in a
  float growth = 0.0f;          // log2 of the scale in b over that in a
  float ratio = 0.8f;           // as MatchDescriptors, among the candidates
};

// Pairs of features that are each other's nearest among the candidates. In order of a.
std::vector<FeatureMatch> MatchGuided(const FeatureGrid& a,
                                      const FeatureGrid& b,
                                      const GuidedOptions& options);

// How the features of b are turned and scaled against their matches in a:
// median growth, mean turn.
void MeasureTurnAndGrowth(const vision::Features& a,
                          const vision::Features& b,
                          std::span<const FeatureMatch> matches,
                          GuidedOptions& options);

}  // namespace lararium::train
