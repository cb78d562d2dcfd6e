#pragma once

// Matches image pairs and keeps those whose matches agree with one two-view geometry.

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
  double threshold_px = 2.0;  // Largest epipolar distance of an inlier.
  double band_px = 4.0;       // Half width of the guided search along epipolar lines.
  size_t min_matches = 20;
  // Pairs with a larger index difference are first tried with their strongest features only.
  uint32_t trusted_gap = 8;
};

struct VerifiedPairs {
  std::vector<VerifiedPair> pairs;  // Ordered as the candidates.
  geometry::CameraModel camera;
  // Images of a film whose index differs by no more than this follow one another and overlap. None
  // if the images are unordered.
  std::optional<uint32_t> film_gap = std::nullopt;
};

// Verifies pairs with known intrinsics.
std::vector<VerifiedPair> VerifyPairs(std::span<const vision::Features> images,
                                      std::span<const ImagePair> candidates,
                                      const geometry::CameraModel& camera,
                                      const VerificationOptions& options,
                                      Progress& progress);

// Verifies pairs without intrinsics, by fundamental matrices. The focal length is the prior if
// given, otherwise the one that the matrices agree on, otherwise 1.2 times the longer side. The
// poses are computed with it.
VerifiedPairs VerifyPairsUncalibrated(std::span<const vision::Features> images,
                                      std::span<const ImagePair> candidates,
                                      int width,
                                      int height,
                                      std::optional<double> focal_prior_px,
                                      const VerificationOptions& options,
                                      Progress& progress);

}  // namespace lararium::train
