#pragma once

// Resamples one camera's image into the image of another camera at the same position.

#include <opencv2/core/mat.hpp>

#include "shared/geometry/camera_model.h"

namespace lararium::geometry {

// For each pixel of to's image, returns the raw pixel at which `from` sees the same ray, in the
// format of cv::remap: CV_32FC2 with to's size. Runs on all cores.
cv::Mat PixelsSeenBy(const CameraModel& from, const CameraModel& to);

}  // namespace lararium::geometry
