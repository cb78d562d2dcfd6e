#pragma once

// Chooses how finely to look for features, so that their number stays near a
// budget: less work where the image is rich, more where it is sparse.

#include <cstddef>

#include "shared/vision/features.h"

namespace lararium::vision {

class LevelOfDetail {
 public:
  explicit LevelOfDetail(int feature_budget);

  // For the next frame.
  FeatureOptions options() const;
  // Where options() already look as finely as these, nothing is left to try.
  FeatureOptions finest_options() const;
  bool finest() const { return level_ == 0; }

  // How many features options() gave. Moves by one level at most, and only when
  // the number is off by more than one level changes it.
  void Observe(size_t features);

 private:
  int budget_;
  int level_;
};

}  // namespace lararium::vision
