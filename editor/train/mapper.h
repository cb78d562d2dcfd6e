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

struct MapperOptions {
  bool refine_intrinsics = false;
  TriangulationOptions triangulation;  // while the map grows
  double final_max_error_px = 2.5;     // of the finished map's observations
  ResectionOptions resection;
  double min_initial_angle = 0.035;  // radians (2 degrees), median over the initial pair's points
  size_t min_initial_points = 40;
};

// The two images that a map started from.
using InitialPair = std::array<uint32_t, 2>;

// Locates as many images as it can, from scratch: the largest of the maps that
// the best pairs grow into. nullopt when no pair can start a map, or when cancelled.
std::optional<InitialPair> MapIncrementally(Reconstruction& reconstruction,
                                            std::span<const VerifiedPair> pairs,
                                            const MapperOptions& options,
                                            Progress& progress,
                                            Log& log);

}  // namespace lararium::train
