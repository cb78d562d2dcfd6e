#pragma once

// A camera that took images of a place, as training knows it.

#include <limits>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"

namespace lararium::train {

struct TrainingCamera {
  geometry::CameraModel model;  // The intrinsics, or the present estimate of them.
  bool given = false;           // The intrinsics are known and stay.
  // What was known of the focal length before, for example from EXIF data: pixels, and the standard
  // deviation as a share. Infinite: nothing was known.
  double known_focal_px = 0.0;
  double focal_doubt = std::numeric_limits<double>::infinity();
  bool assumed = false;  // See SourceCamera::assumed.
  cv::Rect area = {};    // See SourceCamera; empty if its images fill the frames.

  bool FocalKnown() const { return given || focal_doubt < 1.0; }
};

// The model of the part of the frames that the camera's images fill.
geometry::CameraModel ModelOfArea(const TrainingCamera& camera);

// The cameras of a source before training. intrinsics: those of the source's frames or, if it has
// several cameras, those of the upright images of one size. Fails if they belong to no
// camera.
Result<std::vector<TrainingCamera>> CamerasOf(
    const capture::FrameSource& source, const std::optional<geometry::CameraModel>& intrinsics);

}  // namespace lararium::train
