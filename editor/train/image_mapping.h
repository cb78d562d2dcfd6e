#pragma once

// Builds a sparse map from images with features: pairs, tracks, reconstruction.

#include <memory>
#include <optional>
#include <span>

#include "editor/train/database_builder.h"
#include "editor/train/mapper.h"
#include "editor/train/pair_verification.h"
#include "editor/train/reconstruction.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::train {

struct ImageMappingOptions {
  // TrainingImage::camera is an index into these. Intrinsics that are not given are estimated.
  std::vector<TrainingCamera> cameras;
  uint64_t seed = 1;
};

// Finds pairs of images that show the same part of the scene, and the intrinsics to start from. All
// images must have the same size. Fails if there is no such pair, or if cancelled.
Result<VerifiedPairs> MatchImages(std::span<TrainingImage> images,
                                  const ImageMappingOptions& options,
                                  Progress& progress,
                                  Log& log);

struct SparseMap {
  std::unique_ptr<Reconstruction> reconstruction;  // Image i is images[i].
  InitialPair anchors = {0, 0};                    // The images from which it started.
};

// Structure from motion over verified pairs. The map frame is the camera frame of the first located
// image; the unit is the median depth. Errors say what to film instead.
Result<SparseMap> MapImages(std::span<const TrainingImage> images,
                            const VerifiedPairs& verified,
                            const ImageMappingOptions& options,
                            Progress& progress,
                            Log& log);

}  // namespace lararium::train
