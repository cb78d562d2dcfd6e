#pragma once

// Chooses how finely to look for features, so that their number stays near a
// budget: less work where the image is rich, more where it is sparse, and more too
// where the pose that they gave is poor.

#include <cstddef>
#include <optional>

#include "shared/vision/features.h"

namespace lararium::vision {

// Of a pose: what it rests on, and how far it can be trusted.
struct PoseQuality {
  int inliers = 0;
  double expected_error_px = 0.0;  // Location::expected_error_px
};

class LevelOfDetail {
 public:
  explicit LevelOfDetail(int feature_budget);

  // For the next frame.
  FeatureOptions options() const;
  // Where options() already look as finely as these, nothing is left to try.
  FeatureOptions finest_options() const;
  bool finest() const { return level_ == 0; }

  // How many features options() gave, and the pose that was found in the image; none:
  // the number alone decides, for the image may show another place. Moves by one level
  // at most, and not where the next would move back.
  void Observe(size_t features, const std::optional<PoseQuality>& pose);

 private:
  int budget_;
  int level_;
};

}  // namespace lararium::vision
