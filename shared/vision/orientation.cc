#include "shared/vision/orientation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lararium::vision {
namespace {

constexpr int kOrientationBins = 36;
using OrientationHistogram = std::array<float, kOrientationBins>;

OrientationHistogram Histogram(const cv::Mat& image, const Extremum& e, OrientationMemory& memory) {
  const float sigma = 1.5f * e.sigma;
  const Window window(image, e.x, e.y, 3.0f * sigma);
  FillGaussian(e.x, sigma, window.x_begin, window.x_end, memory.weights_x);
  FillGaussian(e.y, sigma, window.y_begin, window.y_end, memory.weights_y);
  std::array<float, kOrientationBins + 1> sums{};
  for (int y = window.y_begin; y < window.y_end; ++y) {
    memory.gradients.Fill(image, y, window.x_begin, window.x_end);
    const float weight = memory.weights_y[y - window.y_begin];
    for (int i = 0; i < window.x_end - window.x_begin; ++i) {
      const float turns = memory.gradients.angle[i] / kTwoPi;
      const int bin = static_cast<int>(std::lround(turns * kOrientationBins));
      sums[bin] += weight * memory.weights_x[i] * memory.gradients.magnitude[i];
    }
  }
  sums[0] += sums[kOrientationBins];
  OrientationHistogram smooth;
  for (int i = 0; i < kOrientationBins; ++i) {
    const auto at = [&](int k) { return sums[(i + k + kOrientationBins) % kOrientationBins]; };
    smooth[i] = (at(-2) + at(2) + 4.0f * (at(-1) + at(1)) + 6.0f * at(0)) / 16.0f;
  }
  return smooth;
}

}  // namespace

void AddOrientations(const cv::Mat& image,
                     const Extremum& extremum,
                     OrientationMemory& memory,
                     std::vector<OrientedExtremum>& out) {
  const OrientationHistogram histogram = Histogram(image, extremum, memory);
  const float least = 0.8f * *std::max_element(histogram.begin(), histogram.end());
  for (int i = 0; i < kOrientationBins; ++i) {
    const float left = histogram[(i + kOrientationBins - 1) % kOrientationBins];
    const float right = histogram[(i + 1) % kOrientationBins];
    const float here = histogram[i];
    if (here > 0.0f && here >= least && here > left && here >= right) {
      const float peak =
          static_cast<float>(i) + 0.5f * (left - right) / (left - 2.0f * here + right);
      float angle = peak * (kTwoPi / kOrientationBins);
      angle = angle < 0.0f ? angle + kTwoPi : angle;
      angle = angle >= kTwoPi ? angle - kTwoPi : angle;
      out.push_back({extremum, angle});
    }
  }
}

}  // namespace lararium::vision
