#pragma once

// The readers and writers of single formats. Private to image.

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/image/decode.h"

namespace lararium::image {

// 8 bits of each.
constexpr int TypeOf(Channels channels) {
  switch (channels) {
    case Channels::kGrey:
      return CV_8UC1;
    case Channels::kBgr:
      return CV_8UC3;
    case Channels::kBgra:
      return CV_8UC4;
  }
  return CV_8UC4;
}

using Bytes = std::span<const std::byte>;

Result<cv::Mat> DecodeJpeg(Bytes encoded,
                           Channels channels,
                           int halvings,
                           const std::string& place);
Result<cv::Mat> DecodePng(Bytes encoded, Channels channels, const std::string& place);
Result<cv::Mat> DecodeTiff(Bytes encoded, Channels channels, const std::string& place);
// BMP, WebP.
Result<cv::Mat> DecodeByLibav(Bytes encoded, Channels channels, const std::string& place);

bool StartsWith(Bytes bytes, size_t at, std::string_view text);

// From BGR or grey of 8 bits.
cv::Mat Converted(const cv::Mat& image, Channels channels);

// What is wrong with a picture that cannot be decoded.
Status Damaged(const std::string& place, const std::string& why);

// Allocates; an error where the size is nothing or beyond kMaxPixels.
Result<cv::Mat> MakeImage(uint64_t width, uint64_t height, int type, const std::string& place);

}  // namespace lararium::image
