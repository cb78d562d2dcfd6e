#pragma once

// Readers and writers of individual formats. Private to image.

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/image/decode.h"

namespace lararium::image {

// OpenCV type of an 8-bit image with these channels.
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
                           const std::string& where);
Result<cv::Mat> DecodePng(Bytes encoded, Channels channels, const std::string& where);
Result<cv::Mat> DecodeTiff(Bytes encoded, Channels channels, const std::string& where);
// Decodes HEIC and AVIF, turned as the file says.
Result<cv::Mat> DecodeHeif(Bytes encoded, Channels channels, const std::string& where);
// Decodes BMP, WebP and JPEG XL, and the files of Photoshop, DirectDraw and Targa.
Result<cv::Mat> DecodeByLibav(Bytes encoded, Channels channels, const std::string& where);

bool IsTiff(Bytes encoded);
bool IsHeif(Bytes encoded);
// Return nullopt if the header cannot be read.
std::optional<cv::Size> ReadTiffSize(Bytes encoded);
std::optional<cv::Size> ReadHeifSize(Bytes encoded);

struct TiffTraits {
  // The number of pages; reduced copies and masks of other pages are not counted.
  int pages = 0;
  std::vector<std::byte> profile;  // The colour profile of the first page; empty if it has none.
};
TiffTraits ReadTiffTraits(Bytes encoded);
// Returns the colour profile of a PNG; empty if it has none or cannot be read.
std::vector<std::byte> ReadPngProfile(Bytes encoded);

bool StartsWith(Bytes bytes, size_t at, std::string_view text);

// Converts an 8-bit BGR or grey image.
cv::Mat Converted(const cv::Mat& image, Channels channels);

// Returns the error for a picture that cannot be decoded.
Status Damaged(const std::string& where, const std::string& why);

// Allocates an image. Returns an error if the size is zero or exceeds kMaxPixels.
Result<cv::Mat> MakeImage(uint64_t width, uint64_t height, int type, const std::string& where);

}  // namespace lararium::image
