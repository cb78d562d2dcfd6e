#include "editor/train/keyframes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "shared/core/check.h"

namespace lararium::train {
namespace {

constexpr double kComparedWidth = 320.0;

double Sharpness(const cv::Mat& grey) {
  cv::Mat laplacian;
  cv::Laplacian(grey, laplacian, CV_16S);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(laplacian, mean, deviation);
  return deviation[0] * deviation[0];
}

double MedianShift(const cv::Mat& from, const cv::Mat& to) {
  constexpr int kCorners = 200;
  constexpr size_t kMinTracked = 20;
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(from, corners, kCorners, 0.01, 6.0);
  if (corners.size() < kMinTracked) {
    return kLostShift;
  }
  std::vector<cv::Point2f> moved;
  std::vector<uint8_t> tracked;
  cv::calcOpticalFlowPyrLK(from, to, corners, moved, tracked, cv::noArray(), cv::Size(15, 15), 4);
  std::vector<double> lengths;
  for (size_t i = 0; i < corners.size(); ++i) {
    if (tracked[i] != 0) {
      lengths.push_back(cv::norm(moved[i] - corners[i]));
    }
  }
  if (lengths.size() < std::max(kMinTracked, corners.size() / 4)) {
    return kLostShift;
  }
  const auto middle = lengths.begin() + static_cast<ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::min(kLostShift, *middle / std::hypot(from.cols, from.rows));
}

}  // namespace

FrameMotion MotionMeter::Measure(const cv::Mat& grey) {
  cv::Mat small = grey;
  const double factor = kComparedWidth / grey.cols;
  if (factor < 1.0) {
    cv::resize(grey, small, cv::Size(), factor, factor, cv::INTER_AREA);
  } else {
    small = grey.clone();  // The caller's pixels may change.
  }
  FrameMotion motion;
  motion.sharpness = Sharpness(small);
  if (!previous_.empty() && previous_.size() == small.size()) {
    motion.shift = MedianShift(previous_, small);
  }
  previous_ = small;
  return motion;
}

std::vector<size_t> ChooseKeyframes(std::span<const FrameMotion> frames, size_t max_count) {
  CHECK(max_count > 0);
  std::vector<size_t> chosen;
  if (frames.size() <= max_count) {
    chosen.resize(frames.size());
    std::iota(chosen.begin(), chosen.end(), size_t{0});
    return chosen;
  }
  // A smaller spacing adds no parallax.
  constexpr double kLeastSpacing = 0.005;
  double total = 0.0;
  for (const FrameMotion& frame : frames) {
    total += frame.shift;
  }
  const double spacing = std::max(kLeastSpacing, total / static_cast<double>(max_count) * 1.0001);
  double travelled = 0.0;
  int64_t stretch = -1;
  for (size_t i = 0; i < frames.size(); ++i) {
    travelled += frames[i].shift;
    const auto here = static_cast<int64_t>(travelled / spacing);
    if (here != stretch) {
      chosen.push_back(i);
      stretch = here;
    } else if (frames[i].sharpness > frames[chosen.back()].sharpness) {
      chosen.back() = i;
    }
  }
  return chosen;
}

}  // namespace lararium::train
