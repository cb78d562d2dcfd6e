#pragma once

// Which frames of a long source shape the map.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace lararium::train {

// How a frame relates to the one before it.
struct FrameMotion {
  double shift = 0.0;      // median length of the optical flow, as a share of the image diagonal
  double sharpness = 0.0;  // variance of the Laplacian of the grey image, at a common size
};

// Measures frames one after another, on images of about 320 pixels width
// (Lucas & Kanade's tracker on pyramids).
class MotionMeter {
 public:
  FrameMotion Measure(const cv::Mat& grey);

 private:
  cv::Mat previous_;
};

// What counts as the shift between frames that flow does not connect.
inline constexpr double kLostShift = 0.25;
// More from frame to frame is too fast for training to follow.
inline constexpr double kFastShift = 0.06;
// A frame of less than this share of the sharpness of those around it is blurred.
inline constexpr double kBlurredShare = 0.35;

// Up to max_count frames at even distances along the accumulated shift, each the
// sharpest of its stretch; all frames when there are no more than max_count.
// Ascending indices. max_count > 0.
std::vector<size_t> ChooseKeyframes(std::span<const FrameMotion> frames, size_t max_count);

}  // namespace lararium::train
