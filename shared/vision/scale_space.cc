#include "shared/vision/scale_space.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lararium::vision {
namespace {

constexpr float kCameraSigma = 0.5f;  // Assumed blur of the input image, pixels.
constexpr int kSmallestOctave = 16;   // Minimum length of the shorter side, pixels.

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

// cv::resize maps coordinate c to s (c + 0.5) - 0.5, which determines the origins.
const ScaleSpace::Sampled& ScaleSpace::Sample(const cv::Mat& grey, int first_octave) {
  sampled_.resize(std::max(sampled_.size(), static_cast<size_t>(std::max(first_octave, 0)) + 2));
  Sampled& plain = sampled_[1];
  grey.convertTo(plain.image, CV_32F, 1.0 / 255.0);
  plain.sigma = kCameraSigma;
  if (first_octave < 0) {
    Sampled& doubled = sampled_[0];
    cv::resize(plain.image, doubled.image, cv::Size(2 * grey.cols, 2 * grey.rows), 0.0, 0.0,
               cv::INTER_LINEAR);
    doubled.sigma = 2.0f * plain.sigma;
    doubled.pixel_size = 0.5f;
    doubled.origin = -0.25f;
    return doubled;
  }
  size_t last = 1;
  for (int i = 0; i < first_octave; ++i, ++last) {
    const Sampled& finer = sampled_[last];
    if (std::min(finer.image.cols, finer.image.rows) <= 1) {
      break;
    }
    Sampled& coarser = sampled_[last + 1];
    const cv::Rect even(0, 0, finer.image.cols & ~1, finer.image.rows & ~1);
    cv::resize(finer.image(even), coarser.image, cv::Size(even.width / 2, even.height / 2), 0.0,
               0.0, cv::INTER_AREA);
    // Averaging two neighbours adds a variance of 1/4 pixel^2.
    coarser.sigma = 0.5f * std::sqrt(finer.sigma * finer.sigma + 0.25f);
    coarser.origin = finer.origin + 0.5f * finer.pixel_size;
    coarser.pixel_size = 2.0f * finer.pixel_size;
  }
  return sampled_[last];
}

void ScaleSpace::Build(const cv::Mat& grey, int first_octave, int scales_per_octave) {
  const Sampled& start = Sample(grey, first_octave);
  first_ = static_cast<size_t>(first_octave + 1);
  octaves_.resize(std::max(octaves_.size(), first_));
  int rows = start.image.rows;
  int columns = start.image.cols;
  for (count_ = 0; std::min(rows, columns) >= kSmallestOctave; ++count_) {
    octaves_.resize(std::max(octaves_.size(), first_ + count_ + 1));
    Octave& octave = octaves_[first_ + count_];
    octave.gaussians.resize(scales_per_octave + 3);
    octave.origin = start.origin;
    if (count_ == 0) {
      octave.pixel_size = start.pixel_size;
      blur_.Apply(start.image, AddedSigma(start.sigma, kBaseSigma), octave.gaussians[0]);
    } else {
      const Octave& finer = octaves_[first_ + count_ - 1];
      octave.pixel_size = 2.0f * finer.pixel_size;
      EverySecondPixel(finer.gaussians[scales_per_octave], octave.gaussians[0]);
    }
    for (int level = 1; level < scales_per_octave + 3; ++level) {
      const float added =
          AddedSigma(SigmaOf(level - 1, scales_per_octave), SigmaOf(level, scales_per_octave));
      blur_.Apply(octave.gaussians[level - 1], added, octave.gaussians[level]);
    }
    rows /= 2;
    columns /= 2;
  }
}

}  // namespace lararium::vision
