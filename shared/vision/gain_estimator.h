#pragma once

// How bright an image is beside the map's photometric reference.

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "shared/vision/follower.h"
#include "shared/vision/scene_database.h"

namespace lararium::vision {

// Allocates nothing after its first images.
class GainEstimator {
 public:
  // Linear R, G, B of the image over the reference: exp of a robust mean of the
  // logarithms of the points' ratios, channel by channel. Each image by itself:
  // nothing adds up. bgr: CV_8UC3, sRGB. nullopt where too few points show it.
  std::optional<std::array<float, 3>> Estimate(const cv::Mat& bgr,
                                               const SceneDatabase& database,
                                               std::span<const SeenPoint> seen);

 private:
  struct Ratio {
    float log = 0.0f;
    float weight = 0.0f;
  };
  static std::optional<float> RobustMean(std::span<Ratio> ratios, std::vector<float>& deviations);

  std::array<std::vector<Ratio>, 3> ratios_;  // of each channel
  std::vector<float> deviations_;
};

}  // namespace lararium::vision
