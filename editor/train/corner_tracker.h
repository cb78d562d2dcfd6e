#pragma once

// Converts the images of a camera that films a place into the input of CoverageGuide.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "editor/train/coverage_guide.h"
#include "editor/train/keyframes.h"
#include "shared/geometry/camera_model.h"

namespace lararium::train {

// Tracks corners from frame to frame on images of about 320 pixels width (pyramidal Lucas-Kanade
// tracker with a backward check), and detects new ones in empty areas. Also extracts the features
// of these images by which views are recognised.
class CornerTracker {
 public:
  // camera describes the images; approximate intrinsics are sufficient.
  explicit CornerTracker(const geometry::CameraModel& camera) : camera_(camera) {}

  // time is in seconds.
  CoverageFrame Measure(const cv::Mat& grey, double time);

 private:
  void Follow(const cv::Mat& small);
  void FindMore(const cv::Mat& small);
  Eigen::Vector2d OnPlane(double x, double y, double factor) const;
  CoverageFeatures Describe(const cv::Mat& small, double factor);

  geometry::CameraModel camera_;
  MotionMeter meter_;
  vision::FeatureExtractor extractor_;
  vision::Features features_;
  cv::Mat previous_;
  std::vector<cv::Point2f> corners_;  // Pixel positions in previous_.
  std::vector<uint32_t> ids_;         // Parallel to corners_.
  uint32_t next_id_ = 0;
};

// A typical camera for images of this size, for use if the intrinsics are unknown.
geometry::CameraModel TypicalCamera(int width, int height);

// Half the width and half the height of a camera's image on the plane z = 1.
Eigen::Vector2d HalfView(const geometry::CameraModel& camera);

}  // namespace lararium::train
