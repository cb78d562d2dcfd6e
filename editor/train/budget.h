#pragma once

// What a map may weigh: the points, descriptors and images that matter most for
// finding one's place in it.

#include <cstdint>
#include <span>
#include <vector>

#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

struct BudgetOptions {
  int max_points = 60'000;
  int max_descriptors_per_point = 0;  // 0: all that it has
  // Share of the sights whose look must be at hand in a keyframe's image, from
  // nearly the same direction and distance; images beyond that are left out. 1: all stay.
  double image_coverage = 1.0;
  uint64_t seed = 1;  // of the new forest

  Status Validate() const;
};

// Up to count points, ascending: greedily those that add most to the keyframes
// that see them, where each part of an image wants points of its own and the
// first matter most (Nemhauser, Wolsey & Fisher, 1978: such a choice reaches at
// least 63 % of the best; for maps, Li, Snavely & Huttenlocher, ECCV 2010).
// Points count more when their descriptors resemble no other's and when their
// features are coarse enough to be found at an image's own size.
std::vector<uint32_t> ChoosePoints(const vision::SceneDatabase& database, size_t count);

// Keyframes, ascending, whose images show that share of all sights, as
// image_coverage says: greedily the one that shows most more.
std::vector<uint32_t> ChooseImages(const vision::SceneDatabase& database, double coverage);

// The database within its budget, with a new forest. Frame, poses and the order
// of points and keyframes stay; keyframes without an image keep their pose.
vision::SceneDatabase Prune(const vision::SceneDatabase& database, const BudgetOptions& options);

// One line of size against recall.
struct BudgetRow {
  int points = 0;
  int descriptors = 0;
  int images = 0;
  size_t bytes = 0;           // of the .larscene file
  double recall = 0.0;        // share of the held-out views that the map locates
  double mean_inliers = 0.0;  // of the located views: what recall has in reserve
  // Median over these views: mean distance in pixels between where the pose and
  // the one that training found project the points in view.
  double median_difference_px = 0.0;
};

// How well smaller maps work: for each of budgets, prunes the map that never saw
// the appearance of every stride-th keyframe with an image, and locates these.
// They must be views between others, or recall says little: stride >= 2. Fails
// where too few keyframes have an image, or when cancelled.
Result<std::vector<BudgetRow>> MeasureBudgets(const vision::SceneDatabase& database,
                                              std::span<const BudgetOptions> budgets,
                                              size_t stride,
                                              Progress& progress);

}  // namespace lararium::train
