#pragma once

// What changes in the camera that filmed a place. Its rolling shutter: how the camera moved while
// each frame was read, and how long that took (after Hedborg, Forssen, Felsberg & Ringaby, "Rolling
// shutter bundle adjustment", CVPR 2012; the motion is that between the frames of the film). Its
// autofocus, which changes the focal length ("breathing").

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/bundle_adjustment.h"
#include "editor/train/mapper.h"
#include "editor/train/reconstruction.h"
#include "shared/core/log.h"

namespace lararium::train {

// The pose of a frame of a film.
struct TimedPose {
  double time = 0.0;  // Counted in frame times.
  geometry::Rigid3 camera_from_map;
};

// [poses]: The motion of the camera during one frame time, from the poses of the frames nearest in
// time, which need not be evenly spaced. Zero where there are too few. poses must be in ascending
// order of time.
std::vector<ImageMotion> EstimateMotions(std::span<const TimedPose> poses);

// Chooses the observations again after the camera of a finished map has changed.
void FitAgain(Reconstruction& reconstruction, const MapperOptions& mapper);

struct Shutter {
  Eigen::Vector2d readout = Eigen::Vector2d::Zero();  // See vision::RollingShutter.
  Eigen::Vector2d deviation = Eigen::Vector2d::Zero();
};

// Estimates the readout time from the map's images and their motions, and adjusts the map to it.
// options say which intrinsics may change. nullopt if the shutter is a global one as far as the
// images tell; the map then stays as it is.
std::optional<Shutter> AdjustToShutter(Reconstruction& reconstruction,
                                       const InitialPair& anchors,
                                       std::vector<ImageMotion> motions,
                                       const MapperOptions& mapper,
                                       BundleOptions options,
                                       Log& log);

// Estimates by how much autofocus has moved the lens in each image of a film, and adjusts the map
// to it. times[image]: See Reconstruction::LetBreathe. options say which intrinsics may change; if
// none may, the given focal length need not be the mean.
// Returns the root mean square of the focal lengths' relative changes; nullopt if the lens stood
// still as far as the images tell: the map then stays as it is.
std::optional<double> AdjustToBreathing(Reconstruction& reconstruction,
                                        const InitialPair& anchors,
                                        std::vector<double> times,
                                        const MapperOptions& mapper,
                                        BundleOptions options,
                                        Log& log);

}  // namespace lararium::train
