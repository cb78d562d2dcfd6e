#pragma once

// What one camera saw, as another camera at the same place would have seen it. A map stores images
// and observations of one camera only.

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// Resamples images of camera `from` to those which camera `to` would have taken. Empty ones stay.
void Resample(geometry::CameraModel from,
              const geometry::CameraModel& to,
              std::span<cv::Mat* const> images);

// Returns the features that lie in the image of camera `to`, at their pixels there.
vision::Features FeaturesIn(const geometry::CameraModel& to,
                            const geometry::CameraModel& from,
                            const vision::Features& features);

// Returns the observations that lie in the image of camera `to`, at their pixels there.
std::vector<vision::Observation> ObservationsIn(const geometry::CameraModel& to,
                                                const geometry::CameraModel& from,
                                                std::vector<vision::Observation> observations);

}  // namespace lararium::train
