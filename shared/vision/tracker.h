#pragma once

// The SIFT tracker: locates single images of a trained place without a prior.

#include <memory>

#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

struct TrackerOptions {
  int feature_budget = 1000;  // what the level-of-detail controller aims at
  int search_checks = 64;     // descriptors looked at for each query
  float ratio = 0.8f;         // Lowe's ratio between different points
  float inlier_threshold_px = 2.0f;
  int hypotheses = 512;  // of preemptive RANSAC
  int min_inliers = 15;
  uint64_t seed = 1;

  Status Validate() const;
};

// camera: of the images that will come. database is shared, never changed.
Result<std::unique_ptr<PoseSource>> CreateSiftTracker(std::shared_ptr<const SceneDatabase> database,
                                                      const geometry::CameraModel& camera,
                                                      const TrackerOptions& options);

}  // namespace lararium::vision
