#pragma once

// An image pyramid for coarse-to-fine search.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace lararium::vision {

// Level l halves the image l times. Pixel x of the image lies at
// (x + 0.5) / 2^l - 0.5 of level l: integer coordinates stay pixel centres.
template <typename T>
T LevelFromPixel(const T& pixel, int level) {
  const auto scale = static_cast<typename T::Scalar>(1.0 / (1 << level));
  const auto half = static_cast<typename T::Scalar>(0.5);
  return (scale * (pixel.array() + half) - half).matrix();
}
template <typename T>
T PixelFromLevel(const T& pixel, int level) {
  const auto scale = static_cast<typename T::Scalar>(1 << level);
  const auto half = static_cast<typename T::Scalar>(0.5);
  return (scale * (pixel.array() + half) - half).matrix();
}

// Reuses its memory from image to image.
class ImagePyramid {
 public:
  // grey is CV_8UC1; level 0 shares its pixels. levels is at least 1. The pyramid ends before a
  // side would become shorter than kLeastSide.
  void Build(const cv::Mat& grey, int levels);

  int levels() const { return levels_; }
  const cv::Mat& level(int l) const { return images_[static_cast<size_t>(l)]; }

  static constexpr int kLeastSide = 16;

 private:
  std::vector<cv::Mat> images_;
  std::vector<uint16_t> column_sums_;
  int levels_ = 0;
};

}  // namespace lararium::vision
