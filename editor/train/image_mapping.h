#pragma once

// From images with features to a map of them: pairs, tracks, reconstruction.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/database_builder.h"
#include "editor/train/mapper.h"
#include "editor/train/pair_verification.h"
#include "editor/train/reconstruction.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::train {

struct ImageMappingOptions {
  // Given intrinsics are kept; otherwise they are estimated from focal_prior_px on.
  std::optional<geometry::CameraModel> intrinsics;
  std::optional<double> focal_prior_px;
  uint64_t seed = 1;
};

// Pairs of images that show the same things, with the camera to start from. An
// error where there is none, or when cancelled. All images have one size.
Result<VerifiedPairs> MatchImages(std::span<TrainingImage> images,
                                  const ImageMappingOptions& options,
                                  Progress& progress,
                                  Log& log);

struct ImageMap {
  std::unique_ptr<Reconstruction> reconstruction;  // image i of it is images[i]
  InitialPair anchors = {0, 0};                    // the images that it started from
};

// Structure from motion over verified pairs, in the axes of the first located
// image's camera; the median depth is the unit. Errors say what to film instead.
Result<ImageMap> MapImages(std::span<const TrainingImage> images,
                           const VerifiedPairs& verified,
                           const ImageMappingOptions& options,
                           Progress& progress,
                           Log& log);

}  // namespace lararium::train
