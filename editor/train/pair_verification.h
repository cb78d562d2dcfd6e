#pragma once

// Matches image pairs and keeps those with one two-view geometry.

#include <optional>
#include <span>
#include <vector>

#include "editor/train/pair_selection.h"
#include "editor/train/tracks.h"
#include "shared/core/progress.h"
#include "shared/geometry/camera_model.h"
#include "shared/vision/features.h"

namespace lararium::train {

struct VerificationOptions {
  float ratio = 0.8f;
  double threshold_px = 2.0;  // of the epipolar distance
  double band_px = 4.0;       // of the search along epipolar lines that few matches gave
  size_t min_matches = 20;
  // Pairs further apart in the source than this are tried on their strongest
  // features first.
  uint32_t trusted_gap = 8;
};

struct VerifiedPairs {
  std::vector<VerifiedPair> pairs;  // in the order of the candidates
  geometry::CameraModel camera;
};

// camera: the known intrinsics.
std::vector<VerifiedPair> VerifyPairs(std::span<const vision::Features> images,
                                      std::span<const ImagePair> candidates,
                                      const geometry::CameraModel& camera,
                                      const VerificationOptions& options,
                                      Progress& progress);

// Without intrinsics: fundamental matrices decide about the matches. The focal
// length is the prior, else what the matrices agree on, else 1.2 times the longer
// side; poses come from there.
VerifiedPairs VerifyPairsUncalibrated(std::span<const vision::Features> images,
                                      std::span<const ImagePair> candidates,
                                      int width,
                                      int height,
                                      std::optional<double> focal_prior_px,
                                      const VerificationOptions& options,
                                      Progress& progress);

}  // namespace lararium::train
