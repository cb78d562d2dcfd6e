#pragma once

#include <opencv2/core/mat.hpp>

#include "shared/geometry/camera_model.h"

namespace lararium::render {

// Rectifies the camera's image to a pinhole camera on the processor, with a precision of 1/32
// pixel. This takes less than half the time that shaders take in a software renderer.
class Rectifier {
 public:
  // Returns an image of the display's size, black outside the camera's field of view; it is valid
  // until the next call. image: not empty, of the camera's size. The map of pixels is
  // computed again only if camera or display changes.
  const cv::Mat& Rectify(const cv::Mat& image,
                         const geometry::CameraModel& camera,
                         const geometry::CameraModel& display);

 private:
  geometry::CameraModel camera_;
  geometry::CameraModel display_;
  cv::Mat whole_;     // CV_16SC2: position in the camera's image of each pixel, whole part
  cv::Mat fraction_;  // fractional part, in the format of cv::remap
  cv::Mat rectified_;
};

}  // namespace lararium::render
