#pragma once

// The tracker: locates the camera in one image without a prior, then tracks it from frame to frame.

#include <memory>
#include <vector>

#include "shared/vision/background/background_search.h"
#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

class TrackedMap;

// When the result of background relocalisation takes effect.
enum class BackgroundWork {
  kJoined,  // A fixed later frame waits for the result, so that the output is reproducible.
  kFree,    // The result is used as soon as it is ready.
};

struct TrackerOptions {
  bool follow = true;  // Track from frame to frame. Otherwise every frame is located by itself.
  // The given camera is that of the images. Otherwise it is only similar, and the intrinsics are
  // estimated.
  bool known_camera = true;
  BackgroundWork background = BackgroundWork::kJoined;
  int threads = 0;            // 0: one thread per core. 1: all work in the caller's thread.
  int feature_budget = 1000;  // Number of features that FeatureScaleController aims at.
  int search_checks = 64;     // See LocalizerOptions, as for the following fields.
  float ratio = 0.8f;
  float inlier_threshold_px = 2.0f;
  int hypotheses = 512;
  int min_inliers = 15;
  uint64_t seed = 1;

  Status Validate() const;
};

// Creates a tracker for one camera. maps holds at least one map; the tracker shares them and never
// changes them. TrackedFrame::map is an index into maps. camera describes the images to come.
// background: what relocalises in the background; by default a thread of this program does. One
// that cannot wait needs BackgroundWork::kFree.
Result<std::unique_ptr<PoseSource>> CreateTracker(
    std::vector<std::shared_ptr<const SceneDatabase>> maps,
    const geometry::CameraModel& camera,
    const TrackerOptions& options,
    std::unique_ptr<BackgroundSearch> background = nullptr);
// A map that is prepared takes part in many trackers, which then begin at once: preparing takes
// longer than the first pose. options.follow must be true.
Result<std::unique_ptr<PoseSource>> CreateTracker(
    std::vector<std::shared_ptr<const TrackedMap>> maps,
    const geometry::CameraModel& camera,
    const TrackerOptions& options,
    std::unique_ptr<BackgroundSearch> background = nullptr);

}  // namespace lararium::vision
