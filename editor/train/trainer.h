#pragma once

// Training: builds the scene database of a place from its images by incremental structure from
// motion (Schoenberger & Frahm, "Structure-from-Motion Revisited", CVPR 2016).

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editor/train/keyframes.h"
#include "editor/train/shutter.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

struct TrainOptions {
  // Given intrinsics are kept, but for what autofocus moves in a film; see CamerasOf for sources of
  // several cameras. Otherwise the focal length and two radial terms of each camera are estimated,
  // with square pixels, starting from the focal length of EXIF data or from that on which the
  // two-view geometries agree best. The principal point is estimated if there is one camera and the
  // images determine it; otherwise it is the image's centre.
  std::optional<geometry::CameraModel> intrinsics;

  uint32_t session = 0;  // Session number of keyframes and points, below 32.
  uint64_t seed = 1;     // The same images and seed give the same bytes.
  // A longer source is thinned out to this many keyframes. Its other frames are located afterwards.
  int max_keyframes = 160;
  int max_features = 6500;     // Maximum number of features per keyframe.
  int max_points = 60'000;     // Maximum number of points of the database; see ChoosePoints.
  bool keep_features = false;  // See TrainResult.

  Status Validate() const;
};

struct LocatedFrame {
  int64_t frame_index = -1;
  std::string name;  // See FrameSource::FrameName.
  geometry::Rigid3 camera_from_map;
  bool keyframe = false;  // False if the frame was located in the finished map.
  // Of the camera in one frame time; zero if it is not known.
  ImageMotion motion = ImageMotion::Zero();
  geometry::CameraModel camera = {};  // The camera of the upright image, see SourceCamera.
};

// The results of training for one frame of the source.
struct FrameReport {
  int64_t frame_index = -1;
  std::string name;
  bool keyframe = false;
  std::optional<geometry::Rigid3> camera_from_map;  // Set if the frame was located.
  ImageMotion camera_motion = ImageMotion::Zero();  // See LocatedFrame::motion.
  geometry::CameraModel camera = {};                // The camera of the source's frames.
  int features = 0;
  // Number of observed map points; for keyframes, before the budget removes points.
  int observations = 0;
  double median_error_px = 0.0;  // Median reprojection error of the observations.
  FrameMotion motion;            // Motion since the frame before, and sharpness.
};

// A camera that took keyframes.
struct CameraReport {
  geometry::CameraModel camera;  // The camera of upright images, see SourceCamera.
  bool given = false;            // The intrinsics were given.
  int keyframes = 0;             // Number of located keyframes.
};

struct TrainReport {
  int frames = 0;                          // Number of frames of the source.
  bool ordered = true;                     // Each image looks like the next one, as in a film.
  int keyframes = 0;                       // Number of frames selected for the map.
  std::vector<LocatedFrame> located;       // Frames with a pose, in the order of the source.
  std::vector<std::string> unlocated;      // Names of frames without a pose.
  std::vector<FrameReport> frame_reports;  // All frames, in the order of the source.
  int points = 0;
  int observations = 0;
  double mean_reprojection_error_px = 0.0;
  // Several if the source is a folder of photographs by different cameras. The map has the images
  // and observations of the one with most keyframes, `camera`, into which those of the others were
  // converted.
  std::vector<CameraReport> cameras;
  geometry::CameraModel camera;
  bool intrinsics_estimated = false;
  // Standard deviations of the estimated intrinsics, assuming independent errors of the
  // observations; 0 for parameters that were not estimated.
  double focal_deviation_px = 0.0;
  double k1_deviation = 0.0;
  double k2_deviation = 0.0;
  bool principal_point_estimated = false;
  double cx_deviation_px = 0.0;
  double cy_deviation_px = 0.0;
  std::optional<Shutter> shutter;  // Set if it is a rolling one.
  // Root mean square of the relative changes of the focal length; set if autofocus moved it.
  std::optional<double> focal_change;
  std::vector<std::string> notes;                       // See FrameSource::Notes.
  std::vector<std::pair<std::string, double>> seconds;  // Wall-clock time of each step.
};

struct TrainResult {
  vision::SceneDatabase database;
  // [keyframe]: Its features at pixels of the database's camera, as its observations are; empty
  // unless TrainOptions::keep_features.
  std::vector<vision::Features> features;
  TrainReport report;
};

// Trains on source, which must be a recording, from its start to its end. Uses all cores. Errors
// say which frames are at fault and what to film instead. Cancelling gives an error.
Result<TrainResult> Train(capture::FrameSource& source,
                          const TrainOptions& options,
                          Progress& progress,
                          Log& log);

}  // namespace lararium::train
