#include "shared/vision/gain_estimator.h"

#include <algorithm>
#include <cmath>

#include "shared/vision/photometry.h"

namespace lararium::vision {
namespace {

constexpr size_t kLeastPoints = 12;
constexpr float kLeastColour = 0.002f;  // Darkest usable reference colour, linear.
constexpr float kLeastScale = 0.02f;    // Minimum spread of the logarithms of the ratios.
constexpr int kIterations = 8;

}  // namespace

// Iteratively reweighted mean with Tukey's loss, starting from the weighted median.
std::optional<float> GainEstimator::RobustMean(std::span<Ratio> ratios,
                                               std::vector<float>& deviations) {
  if (ratios.size() < kLeastPoints) {
    return std::nullopt;
  }
  std::sort(ratios.begin(), ratios.end(),
            [](const Ratio& a, const Ratio& b) { return a.log < b.log; });
  float total = 0.0f;
  for (const Ratio& ratio : ratios) {
    total += ratio.weight;
  }
  float mean = ratios.back().log;
  float below = 0.0f;
  for (const Ratio& ratio : ratios) {
    below += ratio.weight;
    if (below >= 0.5f * total) {
      mean = ratio.log;
      break;
    }
  }
  deviations.clear();
  for (const Ratio& ratio : ratios) {
    deviations.push_back(std::abs(ratio.log - mean));
  }
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  const float scale = std::max(1.4826f * *middle, kLeastScale);
  const float limit = 4.685f * scale;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    float sum = 0.0f;
    float weights = 0.0f;
    for (const Ratio& ratio : ratios) {
      const float deviation = (ratio.log - mean) / limit;
      const float root = std::max(0.0f, 1.0f - deviation * deviation);
      const float weight = ratio.weight * root * root;
      sum += weight * ratio.log;
      weights += weight;
    }
    mean = sum / weights;
  }
  return mean;
}

std::optional<std::array<float, 3>> GainEstimator::Estimate(const cv::Mat& bgr,
                                                            const SceneDatabase& database,
                                                            std::span<const SeenPoint> seen) {
  if (database.colours.empty() || bgr.empty()) {
    return std::nullopt;
  }
  for (std::vector<Ratio>& ratios : ratios_) {
    ratios.clear();
    ratios.reserve(seen.size());
  }
  for (const SeenPoint& point : seen) {
    const auto colour = SampleLinear(bgr, point.pixel.x(), point.pixel.y());
    if (!colour) {
      continue;
    }
    const Eigen::Vector3f& reference = database.colours[point.point];
    for (int channel = 0; channel < 3; ++channel) {
      const float weight = colour->weight[channel];
      if (weight > 0.0f && colour->rgb[channel] > 0.0f && reference[channel] > kLeastColour) {
        ratios_[static_cast<size_t>(channel)].push_back(
            {std::log(colour->rgb[channel] / reference[channel]), weight});
      }
    }
  }
  std::array<float, 3> gain{};
  deviations_.reserve(seen.size());
  for (size_t channel = 0; channel < 3; ++channel) {
    const auto mean = RobustMean(ratios_[channel], deviations_);
    if (!mean) {
      return std::nullopt;
    }
    gain[channel] = std::exp(*mean);
  }
  return gain;
}

}  // namespace lararium::vision
