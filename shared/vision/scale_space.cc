#include "shared/vision/scale_space.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lararium::vision {
namespace {

constexpr float kCameraSigma = 0.5f;  // blur of the image as it comes, pixels
constexpr int kSmallestOctave = 16;   // pixels along the shorter side

float AddedSigma(float from, float to) { return std::sqrt(std::max(to * to - from * from, 1e-4f)); }

// The octave's first level, not yet blurred: its blur is sigma octave pixels.
struct Start {
  cv::Mat image;
  float sigma;
  float pixel_size;
  float origin;
};

// Resizing by areas or lines keeps c' = s (c + 0.5) - 0.5, hence the origins.
Start StartOf(const cv::Mat& grey, int first_octave) {
  Start start{cv::Mat(), kCameraSigma, 1.0f, 0.0f};
  grey.convertTo(start.image, CV_32F, 1.0 / 255.0);
  if (first_octave < 0) {
    cv::resize(start.image, start.image, cv::Size(), 2.0, 2.0, cv::INTER_LINEAR);
    start.sigma *= 2.0f;
    start.pixel_size = 0.5f;
    start.origin = -0.25f;
  }
  for (int i = 0; i < first_octave; ++i) {
    const cv::Rect even(0, 0, start.image.cols & ~1, start.image.rows & ~1);
    cv::Mat half;
    cv::resize(start.image(even), half, cv::Size(even.width / 2, even.height / 2), 0.0, 0.0,
               cv::INTER_AREA);
    start.image = half;
    // The mean of two neighbours has variance 1/4 of a pixel squared.
    start.sigma = 0.5f * std::sqrt(start.sigma * start.sigma + 0.25f);
    start.origin += 0.5f * start.pixel_size;
    start.pixel_size *= 2.0f;
  }
  return start;
}

cv::Mat EverySecondPixel(const cv::Mat& image) {
  cv::Mat half(image.rows / 2, image.cols / 2, CV_32F);
  for (int y = 0; y < half.rows; ++y) {
    const float* from = image.ptr<float>(2 * y);
    float* to = half.ptr<float>(y);
    for (int x = 0; x < half.cols; ++x) {
      to[x] = from[2 * x];
    }
  }
  return half;
}

void FillLevels(Octave& octave, const std::vector<float>& added_sigmas) {
  for (size_t level = 1; level < octave.gaussians.size(); ++level) {
    const cv::Mat& finer = octave.gaussians[level - 1];
    cv::GaussianBlur(finer, octave.gaussians[level], cv::Size(), added_sigmas[level]);
    cv::subtract(octave.gaussians[level], finer, octave.differences[level - 1]);
  }
}

}  // namespace

std::vector<Octave> BuildScaleSpace(const cv::Mat& grey, int first_octave, int scales_per_octave) {
  const int levels = scales_per_octave + 3;
  std::vector<float> added_sigmas(levels, 0.0f);
  for (int level = 1; level < levels; ++level) {
    const float finer = kBaseSigma * std::exp2(static_cast<float>(level - 1) / scales_per_octave);
    const float coarser = kBaseSigma * std::exp2(static_cast<float>(level) / scales_per_octave);
    added_sigmas[level] = AddedSigma(finer, coarser);
  }

  Start start = StartOf(grey, first_octave);
  cv::GaussianBlur(start.image, start.image, cv::Size(), AddedSigma(start.sigma, kBaseSigma));

  std::vector<Octave> octaves;
  cv::Mat base = start.image;
  float pixel_size = start.pixel_size;
  while (std::min(base.rows, base.cols) >= kSmallestOctave) {
    Octave& octave = octaves.emplace_back();
    octave.pixel_size = pixel_size;
    octave.origin = start.origin;
    octave.gaussians.resize(levels);
    octave.differences.resize(levels - 1);
    octave.gaussians[0] = base;
    FillLevels(octave, added_sigmas);
    base = EverySecondPixel(octave.gaussians[scales_per_octave]);
    pixel_size *= 2.0f;
  }
  return octaves;
}

}  // namespace lararium::vision
