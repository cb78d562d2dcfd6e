#pragma once

// Estimates the brightness of an image relative to the map's photometric reference.

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

// Allocates nothing in steady state.
class GainEstimator {
 public:
  // The gain of the image over the reference, linear R, G, B: for each channel, exp of a robust
  // mean of the logarithms of the points' ratios. Every image is estimated by itself, so errors do
  // not accumulate. bgr is CV_8UC3, sRGB. nullopt if too few points are usable.
  std::optional<std::array<float, 3>> Estimate(const cv::Mat& bgr,
                                               const SceneDatabase& database,
                                               std::span<const SeenPoint> seen);

 private:
  struct Ratio {
    float log = 0.0f;
    float weight = 0.0f;
  };
  static std::optional<float> RobustMean(std::span<Ratio> ratios, std::vector<float>& deviations);

  std::array<std::vector<Ratio>, 3> ratios_;  // [channel]
  std::vector<float> deviations_;
};

}  // namespace lararium::vision
