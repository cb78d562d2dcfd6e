#include "shared/vision/photometry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/core/check.h"
#include "shared/core/srgb.h"

namespace lararium::vision {
namespace {

constexpr uint8_t kClipped = 230;  // A sample with a pixel this bright (sRGB) counts as clipped.

// The weight rises from 0 at kBlack to 1 at kShadow and falls from 1 at kHighlight to 0 at kWhite.
// Linear values.
constexpr float kBlack = 0.004f;
constexpr float kShadow = 0.02f;
constexpr float kHighlight = 0.4f;
constexpr float kWhite = 0.65f;

std::array<float, 256> MakeLinearTable() {
  std::array<float, 256> table;
  for (size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(lararium::LinearFromSrgb(static_cast<double>(i) / 255.0));
  }
  return table;
}

const std::array<float, 256>& LinearTable() {
  static const std::array<float, 256> kTable = MakeLinearTable();
  return kTable;
}

float Weight(float linear, uint8_t brightest) {
  if (brightest >= kClipped) {
    return 0.0f;
  }
  const float rise = (linear - kBlack) / (kShadow - kBlack);
  const float fall = (kWhite - linear) / (kWhite - kHighlight);
  return std::clamp(std::min(rise, fall), 0.0f, 1.0f);
}

}  // namespace

float LinearFromSrgb(uint8_t encoded) { return LinearTable()[encoded]; }

cv::Mat LinearFromSrgb(const cv::Mat& bgr) {
  DCHECK(bgr.type() == CV_8UC3);
  cv::Mat linear(bgr.size(), CV_32FC3);
  for (int row = 0; row < bgr.rows; ++row) {
    for (int column = 0; column < bgr.cols; ++column) {
      const cv::Vec3b& pixel = bgr.at<cv::Vec3b>(row, column);
      for (int c = 0; c < 3; ++c) {
        linear.at<cv::Vec3f>(row, column)[c] = LinearFromSrgb(pixel[2 - c]);
      }
    }
  }
  return linear;
}

std::optional<LinearColour> SampleLinear(const cv::Mat& bgr, float x, float y) {
  DCHECK(bgr.type() == CV_8UC3);
  constexpr int kRadius = kSampleSize / 2;
  constexpr float kFarthest = 1e6f;  // Larger than any image; keeps the casts defined.
  if (!(std::abs(x) < kFarthest && std::abs(y) < kFarthest)) {
    return std::nullopt;
  }
  const int left = static_cast<int>(std::lround(x)) - kRadius;
  const int top = static_cast<int>(std::lround(y)) - kRadius;
  if (left < 0 || top < 0 || left + kSampleSize > bgr.cols || top + kSampleSize > bgr.rows) {
    return std::nullopt;
  }
  const std::array<float, 256>& linear = LinearTable();
  std::array<float, 3> sums = {};
  std::array<uint8_t, 3> brightest = {};
  for (int row = top; row < top + kSampleSize; ++row) {
    const uint8_t* pixel = bgr.ptr<uint8_t>(row) + 3 * left;
    for (int i = 0; i < 3 * kSampleSize; i += 3) {
      for (int c = 0; c < 3; ++c) {
        sums[c] += linear[pixel[i + c]];
        brightest[c] = std::max(brightest[c], pixel[i + c]);
      }
    }
  }
  LinearColour colour;
  for (int c = 0; c < 3; ++c) {
    const int bgr_channel = 2 - c;
    colour.rgb[c] = sums[bgr_channel] / static_cast<float>(kSampleSize * kSampleSize);
    colour.weight[c] = Weight(colour.rgb[c], brightest[bgr_channel]);
  }
  return colour;
}

}  // namespace lararium::vision
