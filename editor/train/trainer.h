#pragma once

// Training: from the images of a place to its scene database, by incremental
// structure from motion (Schoenberger & Frahm, "Structure-from-Motion
// Revisited", CVPR 2016).

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editor/train/keyframes.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

struct TrainOptions {
  // Given intrinsics are kept. Otherwise the focal length and two radial terms
  // are estimated, with square pixels, and the principal point where the images
  // determine it; else it is the image's centre.
  std::optional<geometry::CameraModel> intrinsics;
  // Where to start the estimate, in pixels, say from EXIF data. Without it the
  // start is the focal length that the two-view geometries agree on best.
  std::optional<double> focal_prior_px;

  uint32_t session = 0;     // written to keyframes and points, below 32
  uint64_t seed = 1;        // the same images and seed give the same bytes
  int max_keyframes = 160;  // a longer source is thinned out to so many; the rest is located after
  int max_features = 6500;  // of each keyframe
  int max_points = 60'000;  // of the database; those of most observations stay

  Status Validate() const;
};

struct LocatedFrame {
  int64_t frame_index = -1;
  std::string name;  // as FrameSource::FrameName
  geometry::Rigid3 camera_from_map;
  bool keyframe = false;  // it shaped the map; otherwise it was located in the finished map
};

// What training found out about one frame of the source.
struct FrameReport {
  int64_t frame_index = -1;
  std::string name;
  bool keyframe = false;
  std::optional<geometry::Rigid3> camera_from_map;  // where it was located
  int features = 0;
  int observations = 0;  // of points of the map; of keyframes before the budget thins it out
  double median_error_px = 0.0;  // of the observations, reprojection
  FrameMotion motion;            // since the frame before, and sharpness
};

struct TrainReport {
  int frames = 0;                          // that the source had
  int keyframes = 0;                       // that were chosen for the map
  std::vector<LocatedFrame> located;       // in the order of the source
  std::vector<std::string> unlocated;      // names of frames without a pose
  std::vector<FrameReport> frame_reports;  // of all frames, in the order of the source
  int points = 0;
  int observations = 0;
  double mean_reprojection_error_px = 0.0;
  geometry::CameraModel camera;
  bool intrinsics_estimated = false;
  // Standard deviations of estimated intrinsics, if the errors of the observations
  // are independent; 0 of what was not estimated.
  double focal_deviation_px = 0.0;
  double k1_deviation = 0.0;
  double k2_deviation = 0.0;
  bool principal_point_estimated = false;
  double cx_deviation_px = 0.0;
  double cy_deviation_px = 0.0;
  std::vector<std::pair<std::string, double>> seconds;  // of each step, wall clock
};

struct TrainResult {
  vision::SceneDatabase database;
  TrainReport report;
};

// Reads source from its start to its end; it must be a recording. Uses all
// cores. Errors say which frames are at fault and what to film instead; a
// cancelled training is an error too.
Result<TrainResult> Train(capture::FrameSource& source,
                          const TrainOptions& options,
                          Progress& progress,
                          Log& log);

}  // namespace lararium::train
