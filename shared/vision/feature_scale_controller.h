#pragma once

// Chooses how finely to detect features, so that their number stays near a budget. Detection gets
// coarser in rich images, and finer in sparse images and after a poor pose.

#include <cstddef>
#include <optional>

#include "shared/vision/features.h"

namespace lararium::vision {

// How well a pose is supported, and its expected error.
struct PoseQuality {
  int inliers = 0;
  double expected_error_px = 0.0;  // Location::expected_error_px
};

class FeatureScaleController {
 public:
  explicit FeatureScaleController(int feature_budget);

  // Options for the next frame.
  FeatureOptions options() const;
  // Options for a second attempt on the same frame; of no use if finest().
  FeatureOptions finest_options() const;
  bool finest() const { return level_ == 0; }

  // Reports how many features options() gave, and the pose that was found. Without a pose only the
  // number counts, because the image may show another place. Moves by at most one level, and only
  // if the next frame is not expected to move back.
  void Observe(size_t features, const std::optional<PoseQuality>& pose);

 private:
  int budget_;
  int level_;
};

}  // namespace lararium::vision
