#pragma once

// The tracker: finds the place in one image without a prior, then follows it from
// frame to frame.

#include <memory>
#include <vector>

#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

// When the work that runs beside the frames (fresh matches from the detector)
// takes effect.
enum class BackgroundWork {
  kJoined,  // at a fixed later frame, which waits for it: the output is reproducible
  kFree,    // as soon as it is done
};

struct TrackerOptions {
  bool follow = true;  // from frame to frame; otherwise every frame is found anew
  BackgroundWork background = BackgroundWork::kJoined;
  int threads = 0;            // 0: as many as cores; 1: all work in the caller's thread
  int feature_budget = 1000;  // what the level-of-detail controller aims at
  int search_checks = 64;     // descriptors looked at for each query
  float ratio = 0.8f;         // Lowe's ratio between different points
  float inlier_threshold_px = 2.0f;
  int hypotheses = 512;  // of preemptive RANSAC
  int min_inliers = 15;
  uint64_t seed = 1;

  Status Validate() const;
};

// maps: at least one; shared, never changed; TrackedFrame::map says which one a
// pose lies in. camera: of the images that will come. One tracker for each camera.
Result<std::unique_ptr<PoseSource>> CreateTracker(
    std::vector<std::shared_ptr<const SceneDatabase>> maps,
    const geometry::CameraModel& camera,
    const TrackerOptions& options);

}  // namespace lararium::vision
