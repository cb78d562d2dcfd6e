#pragma once

// A camera that took images of a place, as training knows it.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
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
  bool assumed = false;                  // See SourceCamera::assumed.
  cv::Rect area = {};                    // See SourceCamera; empty if its images fill the frames.
  std::optional<uint32_t> lens_of = {};  // See SourceCamera. Both have the same intrinsics, turned.
  int quarter_turns = 0;                 // See SourceCamera.
  // The focal length as a share of that of lens_of: set if this is that camera while autofocus has
  // moved its lens, in one image.
  std::optional<double> focal_ratio = {};

  bool FocalKnown() const { return given || focal_doubt < 1.0; }
};

// The model of the part of the frames that the camera's images fill.
geometry::CameraModel ModelOfArea(const TrainingCamera& camera);

// The camera for images that are turned by a right angle, clockwise.
geometry::CameraModel Turned(const geometry::CameraModel& camera);
// The index of the first camera with the lens of a camera.
uint32_t LensOf(std::span<const TrainingCamera> cameras, uint32_t camera);
// The index of the camera with the mean focal length, for one whose lens autofocus has moved.
uint32_t MeanCamera(std::span<const TrainingCamera> cameras, uint32_t camera);
// How many lenses the cameras have.
size_t LensCount(std::span<const TrainingCamera> cameras);
// By how many right angles, clockwise, the images of `from` are turned to lie as those of `to`.
int QuarterTurns(const TrainingCamera& from, const TrainingCamera& to);
// The intrinsics of `from` for the images of `to`, which has the same lens.
geometry::CameraModel TurnedModel(const TrainingCamera& from, const TrainingCamera& to);
// The pixel of `to` at which the lens sees what `from` sees at a pixel.
Eigen::Vector2d TurnedPixel(const TrainingCamera& from,
                            const TrainingCamera& to,
                            Eigen::Vector2d pixel);

// The cameras of a source before training. intrinsics: those of the source's frames or, if it has
// several cameras, those of the upright images of one size, and of all others that the same lenses
// took. Fails if they belong to no camera.
Result<std::vector<TrainingCamera>> CamerasOf(
    const capture::FrameSource& source, const std::optional<geometry::CameraModel>& intrinsics);

}  // namespace lararium::train
