#pragma once

// From one camera's image to what another would have taken from the same place.

#include <opencv2/core/mat.hpp>

#include "shared/geometry/camera_model.h"

namespace lararium::geometry {

// For each pixel of to's image the raw pixel at which from sees the same ray, as cv::remap has it:
// CV_32FC2, of to's size. Spread over the cores.
cv::Mat PixelsSeenBy(const CameraModel& from, const CameraModel& to);

}  // namespace lararium::geometry
