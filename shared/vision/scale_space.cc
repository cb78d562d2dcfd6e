#include "shared/vision/scale_space.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lararium::vision {
namespace {

constexpr float kCameraSigma = 0.5f;  // blur of the image as it comes, pixels
constexpr int kSmallestOctave = 16;   // pixels along the shorter side

float AddedSigma(float from, float to) { return std::sqrt(std::max(to * to - from * from, 1e-4f)); }

// Blur of level l in octave pixels.
float SigmaOf(int level, int scales_per_octave) {
  return kBaseSigma * std::exp2(static_cast<float>(level) / static_cast<float>(scales_per_octave));
}

void EverySecondPixel(const cv::Mat& image, cv::Mat& half) {
  half.create(image.rows / 2, image.cols / 2, CV_32F);
  for (int y = 0; y < half.rows; ++y) {
    const float* from = image.ptr<float>(2 * y);
    float* to = half.ptr<float>(y);
    for (int x = 0; x < half.cols; ++x, from += 2) {
      to[x] = *from;
    }
  }
}

}  // namespace

// Resizing by areas or lines keeps c' = s (c + 0.5) - 0.5, hence the origins.
float ScaleSpace::Start(const cv::Mat& grey, int first_octave, Octave& octave) {
  octave.pixel_size = 1.0f;
  octave.origin = 0.0f;
  float sigma = kCameraSigma;
  grey.convertTo(grey_, CV_32F, 1.0 / 255.0);
  if (first_octave < 0) {
    cv::resize(grey_, start_, cv::Size(2 * grey.cols, 2 * grey.rows), 0.0, 0.0, cv::INTER_LINEAR);
    octave.pixel_size = 0.5f;
    octave.origin = -0.25f;
    return 2.0f * sigma;
  }
  start_ = grey_;
  for (int i = 0; i < first_octave && std::min(start_.cols, start_.rows) > 1; ++i) {
    const cv::Rect even(0, 0, start_.cols & ~1, start_.rows & ~1);
    cv::Mat half;
    cv::resize(start_(even), half, cv::Size(even.width / 2, even.height / 2), 0.0, 0.0,
               cv::INTER_AREA);
    start_ = half;
    // The mean of two neighbours has variance 1/4 of a pixel squared.
    sigma = 0.5f * std::sqrt(sigma * sigma + 0.25f);
    octave.origin += 0.5f * octave.pixel_size;
    octave.pixel_size *= 2.0f;
  }
  return sigma;
}

void ScaleSpace::Build(const cv::Mat& grey, int first_octave, int scales_per_octave) {
  Octave first;
  const float sigma = Start(grey, first_octave, first);
  int rows = start_.rows;
  int columns = start_.cols;
  for (count_ = 0; std::min(rows, columns) >= kSmallestOctave; ++count_) {
    if (count_ == octaves_.size()) {
      octaves_.emplace_back();
    }
    Octave& octave = octaves_[count_];
    octave.gaussians.resize(scales_per_octave + 3);
    octave.differences.resize(scales_per_octave + 2);
    if (count_ == 0) {
      octave.pixel_size = first.pixel_size;
      blur_.Apply(start_, AddedSigma(sigma, kBaseSigma), octave.gaussians[0], nullptr);
    } else {
      const Octave& finer = octaves_[count_ - 1];
      octave.pixel_size = 2.0f * finer.pixel_size;
      EverySecondPixel(finer.gaussians[scales_per_octave], octave.gaussians[0]);
    }
    octave.origin = first.origin;
    for (int level = 1; level < scales_per_octave + 3; ++level) {
      const float added =
          AddedSigma(SigmaOf(level - 1, scales_per_octave), SigmaOf(level, scales_per_octave));
      blur_.Apply(octave.gaussians[level - 1], added, octave.gaussians[level],
                  &octave.differences[level - 1]);
    }
    rows /= 2;
    columns /= 2;
  }
}

}  // namespace lararium::vision
