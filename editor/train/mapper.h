#pragma once

// Incremental structure from motion over verified pairs and their tracks.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "editor/train/reconstruction.h"
#include "editor/train/resection.h"
#include "editor/train/tracks.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"

namespace lararium::train {

// Number of points that each image contributes to the last bundle adjustments; see BundleOptions.
// More points hardly change the poses, and adjusting all of them takes three times as long.
inline constexpr size_t kFinalPointsPerImage = 1500;

struct MapperOptions {
  bool refine_intrinsics = false;
  // Images whose camera is only assumed may have been taken by several cameras. Not so for the
  // frames of a film.
  bool tell_cameras_apart = false;
  TriangulationOptions triangulation;  // Limits while the map grows.
  double final_max_error_px = 2.5;     // Largest observation error in the finished map.
  ResectionOptions resection;
  double min_initial_angle = 0.035;  // Median over the initial pair's points, radians (2 degrees).
  size_t min_initial_points = 40;
  bool draft = false;  // Leaves out the final refinement.
};

// The two images from which a map started.
using InitialPair = std::array<uint32_t, 2>;

// Grows maps from the best pairs and keeps the one with the most located images. nullopt if no pair
// can start a map, or if cancelled.
std::optional<InitialPair> MapIncrementally(Reconstruction& reconstruction,
                                            std::span<const VerifiedPair> pairs,
                                            const MapperOptions& options,
                                            Progress& progress,
                                            Log& log);

}  // namespace lararium::train
