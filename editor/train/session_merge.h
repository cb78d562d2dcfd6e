#pragma once

// Merges sessions: a recording of the same place in other light becomes part of the map.

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

// The number of the next session: one more than the highest in the map.
uint32_t NextSession(const vision::SceneDatabase& map);

struct MergeOptions {
  int max_points = 60'000;            // Maximum number of points of the merged database.
  int max_descriptors_per_point = 6;  // Maximum number per session.
  uint64_t seed = 1;
};

struct MergeReport {
  int keyframes = 0;      // Number of the session's keyframes.
  int located = 0;        // Keyframes located in the map by appearance alone that agree.
  int shared_points = 0;  // Points of the map that the session observes, too.
  int added_points = 0;   // Points that only the session observes.
  // Initial alignment of the session with the map, before the joint adjustment.
  geometry::Similarity3 map_from_session;
};

struct MergedMap {
  vision::SceneDatabase database;
  MergeReport report;
};

// Merges a session that was trained by itself into a map. The map's frame and the poses of its
// keyframes stay fixed; its points may move because of the new observations. features[k] are the
// features of the session's keyframe k at raw pixels of session.camera; each observation is at the
// pixel of one of them (TrainResult::features). The session's keyframes come after those of the
// map. The merged database has the map's camera: pixels and images of another camera are resampled,
// and content outside the image is left out. Fails if too few of the session's keyframes are
// located in the map.
Result<MergedMap> MergeSession(const vision::SceneDatabase& map,
                               const vision::SceneDatabase& session,
                               std::span<const vision::Features> features,
                               const MergeOptions& options,
                               Log& log);

// Implements `train --add`: trains source by itself, then merges it into map as the next session
// (options.session is ignored). Without options.intrinsics, the map's camera is used if
// RecogniseCamera finds that it took the images; otherwise intrinsics are estimated. The report
// describes source, in the map's frame; points, observations and error are those of the merged
// database. map itself is never changed.
Result<TrainResult> AddSession(const vision::SceneDatabase& map,
                               capture::FrameSource& source,
                               const TrainOptions& options,
                               Progress& progress,
                               Log& log);

}  // namespace lararium::train
