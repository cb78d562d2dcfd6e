#pragma once

// How a camera turned between two images, from the images as a whole, made very
// small: quick, and good to a few pixels even for a shake.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "shared/geometry/camera_model.h"

namespace lararium::vision {

struct RotationEstimate {
  Eigen::Quaterniond now_from_before = Eigen::Quaterniond::Identity();
  double noise = 0.0;  // root mean square of what is left, grey levels
};

// Least squares over all pixels with gain and offset of the brightness, weights
// that spare what moves by itself, and no lens distortion. before, now: CV_8UC1 of
// camera's size, a few thousand pixels at most. nullopt where they show too little.
std::optional<RotationEstimate> EstimateRotation(const cv::Mat& before,
                                                 const cv::Mat& now,
                                                 const geometry::CameraModel& camera,
                                                 const Eigen::Quaterniond& start);

}  // namespace lararium::vision
