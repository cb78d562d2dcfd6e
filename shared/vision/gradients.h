#pragma once

// Gradients around a keypoint, row by row. Used by feature extraction only.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace lararium::vision {

inline constexpr float kTwoPi = 2.0f * std::numbers::pi_v<float>;

// The angle of (x, y) in [0, 2 pi), accurate to 1e-5 (Abramowitz & Stegun, "Handbook of
// Mathematical Functions", 4.4.49), in a form that compilers vectorise.
inline float Angle(float y, float x) {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float t = std::min(ax, ay) / (std::max(ax, ay) + 1e-30f);
  const float t2 = t * t;
  float angle = t * (0.9998660f +
                     t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f))));
  angle = ay > ax ? 0.25f * kTwoPi - angle : angle;
  angle = x < 0.0f ? 0.5f * kTwoPi - angle : angle;
  angle = y < 0.0f ? kTwoPi - angle : angle;
  return angle;
}

// Number of extra samples at the end of a row, so that vectorised loops may read past its end.
inline constexpr int kRowPadding = 8;

// Magnitudes and angles of the image gradient in part of a row.
struct GradientRow {
  std::vector<float> magnitude;
  std::vector<float> angle;

  void Fill(const cv::Mat& image, int row, int begin, int end) {
    const float* above = image.ptr<float>(row - 1) + begin;
    const float* here = image.ptr<float>(row) + begin;
    const float* below = image.ptr<float>(row + 1) + begin;
    const int count = end - begin;
    if (static_cast<size_t>(count + kRowPadding) > magnitude.size()) {
      magnitude.resize(count + kRowPadding);
      angle.resize(count + kRowPadding);
    }
    float* m = magnitude.data();
    float* a = angle.data();
    for (int i = 0; i < count; ++i) {
      const float dx = here[i + 1] - here[i - 1];
      const float dy = below[i] - above[i];
      m[i] = std::sqrt(dx * dx + dy * dy);
      a[i] = Angle(dy, dx);
    }
  }
};

// Fills weights with exp(-d^2 / (2 sigma^2)), d being the distance of begin, begin + 1, ... from
// centre.
inline void FillGaussian(
    float centre, float sigma, int begin, int end, std::vector<float>& weights) {
  weights.resize(std::max(end - begin, 0) + kRowPadding);
  for (int i = begin; i < end; ++i) {
    const float d = (static_cast<float>(i) - centre) / sigma;
    weights[i - begin] = std::exp(-0.5f * d * d);
  }
}

// The pixels of a square around (x, y) at which gradients can be computed.
struct Window {
  int x_begin, x_end, y_begin, y_end;

  Window(const cv::Mat& image, float x, float y, float radius)
      : x_begin(std::max(static_cast<int>(std::ceil(x - radius)), 1)),
        x_end(std::min(static_cast<int>(std::floor(x + radius)) + 1, image.cols - 1)),
        y_begin(std::max(static_cast<int>(std::ceil(y - radius)), 1)),
        y_end(std::min(static_cast<int>(std::floor(y + radius)) + 1, image.rows - 1)) {}
};

}  // namespace lararium::vision
