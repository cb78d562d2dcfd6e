#pragma once

// From the images of a camera that films a place to what CoverageGuide judges it by.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "editor/train/coverage_guide.h"
#include "editor/train/keyframes.h"
#include "shared/geometry/camera_model.h"

namespace lararium::train {

// Follows corners from frame to frame, on images of about 320 pixels width (Lucas & Kanade's
// tracker on pyramids, checked backwards), and finds new ones where none are. Describes features of
// these images, too, by which views are recognised.
class CornerTracker {
 public:
  // Of the images; nothing needs to be exact.
  explicit CornerTracker(const geometry::CameraModel& camera) : camera_(camera) {}

  // time: seconds.
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
  std::vector<cv::Point2f> corners_;  // in previous_
  std::vector<uint32_t> ids_;         // of the same index
  uint32_t next_id_ = 0;
};

// A camera of these images whose intrinsics nobody knows: as most are.
geometry::CameraModel TypicalCamera(int width, int height);

// Half of what a camera sees to either side and up and down, on the plane z = 1.
Eigen::Vector2d HalfView(const geometry::CameraModel& camera);

}  // namespace lararium::train
