#pragma once

// Selects the keyframes of a long source, from which the map is built.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace lararium::train {

// The motion since the frame before, and the sharpness of the frame.
struct FrameMotion {
  double shift = 0.0;      // Median length of the optical flow, as a share of the image diagonal.
  double sharpness = 0.0;  // Variance of the Laplacian of the grey image, at a common size.
};

// Measures consecutive frames on images of about 320 pixels width, with the pyramidal Lucas-Kanade
// tracker.
class MotionMeter {
 public:
  FrameMotion Measure(const cv::Mat& grey);

 private:
  cv::Mat previous_;
};

// The shift that is assumed between frames without usable optical flow.
inline constexpr double kLostShift = 0.25;
// A larger shift from frame to frame is too fast for training.
inline constexpr double kFastShift = 0.06;
// A frame is blurred if its sharpness is below this share of that of the surrounding frames.
inline constexpr double kBlurredShare = 0.35;

// Selects up to max_count frames, evenly spaced along the accumulated shift; each is the sharpest
// of its stretch. Selects all frames if there are no more than max_count. Returns ascending
// indices. max_count > 0.
std::vector<size_t> ChooseKeyframes(std::span<const FrameMotion> frames, size_t max_count);

}  // namespace lararium::train
