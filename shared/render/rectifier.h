#pragma once

#include <opencv2/core/mat.hpp>

#include "shared/geometry/camera_model.h"

namespace lararium::render {

// The camera's image as an undistorted pinhole sees it, worked out by the processor: to a 32nd of
// a pixel, in less than half of the time that it takes shaders that software runs.
class Rectifier {
 public:
  // Of the display's size, black where the camera does not see; good until the next call. image:
  // CV_8UC3, not empty, of the camera's size. Where each pixel lies is worked out anew only for
  // other cameras.
  const cv::Mat& Rectify(const cv::Mat& image,
                         const geometry::CameraModel& camera,
                         const geometry::CameraModel& display);

 private:
  geometry::CameraModel camera_;
  geometry::CameraModel display_;
  cv::Mat whole_;     // of the camera's image, for each pixel: CV_16SC2
  cv::Mat fraction_;  // what is left, as cv::remap has it
  cv::Mat rectified_;
};

}  // namespace lararium::render
