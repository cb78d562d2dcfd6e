#pragma once

// Estimates how the camera turned between two very small images, by direct alignment of all
// pixels. Fast, and accurate to a few pixels even when the camera shakes.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "shared/geometry/camera_model.h"

namespace lararium::vision {

struct RotationEstimate {
  Eigen::Quaterniond now_from_before = Eigen::Quaterniond::Identity();
  double noise = 0.0;  // Root mean square of the residuals, grey levels.
};

// Robust least squares over all pixels, with gain and offset of the brightness. Lens distortion is
// ignored. before and now are CV_8UC1 of the camera's size, a few thousand pixels at most. nullopt
// if the images overlap too little or do not determine the rotation.
std::optional<RotationEstimate> EstimateRotation(const cv::Mat& before,
                                                 const cv::Mat& now,
                                                 const geometry::CameraModel& camera,
                                                 const Eigen::Quaterniond& start);

}  // namespace lararium::vision
