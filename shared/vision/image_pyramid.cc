#include "shared/vision/image_pyramid.h"

#include <algorithm>

#include "shared/core/check.h"

namespace lararium::vision {
namespace {

// Each pixel of half is the mean of 4x4 pixels of image with the weights 1 3 3 1 along both axes,
// symmetric about the common corner of the four inner pixels. Outer pixels are repeated at the
// border. sums is working memory [image.cols + 2].
void Halve(const cv::Mat& image, cv::Mat& half, std::vector<uint16_t>& sums) {
  const int width = image.cols;
  for (int row = 0; row < half.rows; ++row) {
    const uint8_t* above = image.ptr<uint8_t>(std::max(2 * row - 1, 0));
    const uint8_t* upper = image.ptr<uint8_t>(2 * row);
    const uint8_t* lower = image.ptr<uint8_t>(2 * row + 1);
    const uint8_t* below = image.ptr<uint8_t>(std::min(2 * row + 2, image.rows - 1));
    uint16_t* sum = sums.data() + 1;
    for (int x = 0; x < width; ++x) {
      sum[x] = static_cast<uint16_t>(above[x] + below[x] + 3 * (upper[x] + lower[x]));
    }
    sum[-1] = sum[0];
    sum[width] = sum[width - 1];
    uint8_t* out = half.ptr<uint8_t>(row);
    for (int x = 0; x < half.cols; ++x) {
      const uint16_t* s = sum + 2 * x - 1;
      out[x] = static_cast<uint8_t>((s[0] + s[3] + 3 * (s[1] + s[2]) + 32) >> 6);
    }
  }
}

}  // namespace

void ImagePyramid::Build(const cv::Mat& grey, int levels) {
  CHECK(grey.type() == CV_8UC1 && levels >= 1);
  images_.resize(std::max(images_.size(), static_cast<size_t>(levels)));
  column_sums_.resize(static_cast<size_t>(grey.cols) + 2);
  images_[0] = grey;
  levels_ = 1;
  while (levels_ < levels) {
    const cv::Mat& image = images_[static_cast<size_t>(levels_ - 1)];
    if (std::min(image.cols, image.rows) / 2 < kLeastSide) {
      break;
    }
    cv::Mat& half = images_[static_cast<size_t>(levels_)];
    half.create(image.rows / 2, image.cols / 2, CV_8UC1);
    Halve(image, half, column_sums_);
    ++levels_;
  }
}

}  // namespace lararium::vision
