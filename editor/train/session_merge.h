#pragma once

// Sessions: a place filmed again, in other light, becomes part of the same map.

#include <cstdint>
#include <span>

#include "editor/train/trainer.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// Below 32; the first that no keyframe of the map has.
uint32_t NextSession(const vision::SceneDatabase& map);

struct MergeOptions {
  int max_points = 60'000;            // of the merged database
  int max_descriptors_per_point = 6;  // from each session
  uint64_t seed = 1;
};

struct MergeReport {
  int keyframes = 0;      // of the session
  int located = 0;        // of these, found in the map by appearance alone and in agreement
  int shared_points = 0;  // of the map, that the session sees too
  int added_points = 0;   // that only the session sees
  // From the session's frame to the map's, before the joint adjustment bent it.
  geometry::Similarity3 map_from_session;
};

struct MergedMap {
  vision::SceneDatabase database;
  MergeReport report;
};

// Joins a session that was trained by itself to a map. The map's frame and the
// poses of its keyframes stay as they are; its points move as far as the new
// sights of them move them. features[k]: of the session's keyframe k, raw pixels
// of session.camera; they may hold more than its observations. Keyframes of the
// session come after the map's. The database has the map's camera: pixels and
// images of another one are resampled, what lies outside is left out. An error
// where too few of the session's keyframes are found in the map.
Result<MergedMap> MergeSession(const vision::SceneDatabase& map,
                               const vision::SceneDatabase& session,
                               std::span<const vision::Features> features,
                               const MergeOptions& options,
                               Log& log);

// `train --add`: trains source by itself, then merges it into map as its next
// session (options.session is not used). Without options.intrinsics the map's
// camera is taken to have filmed it where the image's proportions agree, and
// intrinsics are estimated where they do not. The report is about source, in the
// map's frame; points, observations and error are those of the merged database.
// map is never changed.
Result<TrainResult> AddSession(const vision::SceneDatabase& map,
                               capture::FrameSource& source,
                               const TrainOptions& options,
                               Progress& progress,
                               Log& log);

}  // namespace lararium::train
