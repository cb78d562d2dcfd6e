#pragma once

// Reduces a map to a budget: keeps the points, descriptors and images that matter most for
// localisation.

#include <cstdint>
#include <span>
#include <vector>

#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// The observations of one keyframe, in the order of points.
std::span<const vision::Observation> ObservationsOf(const vision::SceneDatabase& database,
                                                    uint32_t keyframe);

struct BudgetOptions {
  int max_points = 60'000;
  int max_descriptors_per_point = 0;  // 0 keeps all.
  // Share of the observations whose appearance, from nearly the same direction and distance, must
  // be available in a keyframe's image. Images that are not needed for this share are removed. 1
  // keeps all images.
  double image_coverage = 1.0;
  // Removes the observations of keyframes that have no image. Tracking looks only into images.
  bool pictured_observations = false;
  uint64_t seed = 1;  // Seed of the new descriptor forest.

  Status Validate() const;
};

// Chooses up to count points, ascending. Greedily takes the point that adds most to the keyframes
// that observe it, where each part of an image needs its own points and the first ones count most
// (Nemhauser, Wolsey & Fisher, 1978: such a choice reaches at least 63 % of the optimum; for maps,
// Li, Snavely & Huttenlocher, ECCV 2010). Points count more if their descriptors are distinctive
// and if their features are coarse enough to be found at an image's own size.
std::vector<uint32_t> ChoosePoints(const vision::SceneDatabase& database, size_t count);

// Chooses keyframes, ascending, whose images cover the given share of all observations; see
// BudgetOptions::image_coverage. Greedily takes the keyframe that covers most of the rest.
std::vector<uint32_t> ChooseImages(const vision::SceneDatabase& database, double coverage);

// Reduces the database to the budget and builds a new forest. Frame, poses and the order of points
// and keyframes stay the same. Keyframes that lose their image keep their pose.
vision::SceneDatabase Prune(const vision::SceneDatabase& database, const BudgetOptions& options);

// Size and recall of a map within one budget.
struct BudgetRow {
  int points = 0;
  int descriptors = 0;
  int images = 0;
  size_t bytes = 0;           // Size of the .larscene file.
  double recall = 0.0;        // Share of the held-out views that the map locates.
  double mean_inliers = 0.0;  // Mean number of inliers of the located views; a safety margin.
  // Median over the located views of the mean distance in pixels between the projections of the
  // visible points by the found pose and by the pose from training.
  double median_difference_px = 0.0;
};

// Measures how well smaller maps work. Holds out every stride-th keyframe with an image, removes
// its appearance from the map, prunes the map to each budget, and locates the held-out keyframes in
// it. stride >= 2, because held-out views must lie between others for the recall to be meaningful.
// Fails if too few keyframes have an image, or if cancelled.
Result<std::vector<BudgetRow>> MeasureBudgets(const vision::SceneDatabase& database,
                                              std::span<const BudgetOptions> budgets,
                                              size_t stride,
                                              Progress& progress);

}  // namespace lararium::train
