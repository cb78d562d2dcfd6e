#include "shared/image/decode.h"

#include <cstring>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "shared/core/check.h"
#include "shared/core/file.h"
#include "shared/image/codecs.h"
#include "shared/image/image_header.h"

namespace lararium::image {

bool StartsWith(Bytes bytes, size_t at, std::string_view text) {
  return at + text.size() <= bytes.size() &&
         std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}

cv::Mat Converted(const cv::Mat& image, Channels channels) {
  const bool grey = image.channels() == 1;
  cv::Mat converted = image;
  if (channels == Channels::kGrey && !grey) {
    cv::cvtColor(image, converted, cv::COLOR_BGR2GRAY);
  } else if (channels == Channels::kBgr && grey) {
    cv::cvtColor(image, converted, cv::COLOR_GRAY2BGR);
  } else if (channels == Channels::kBgra) {
    cv::cvtColor(image, converted, grey ? cv::COLOR_GRAY2BGRA : cv::COLOR_BGR2BGRA);
  }
  return converted;
}

Status Damaged(const std::string& where, const std::string& why) {
  return Status::Error(where, "the image is damaged or cut short (" + why + ")",
                       "replace it, or save it again as PNG");
}

Result<cv::Mat> MakeImage(uint64_t width, uint64_t height, int type, const std::string& where) {
  if (width == 0 || height == 0 || width > kMaxPixels || height > kMaxPixels ||
      width * height > kMaxPixels) {
    return Status::Error(
        where, "is an image of " + std::to_string(width) + "x" + std::to_string(height) + " pixels",
        "scale it to at most " + std::to_string(kMaxPixels / 1'000'000) + " million");
  }
  return cv::Mat(static_cast<int>(height), static_cast<int>(width), type);
}

Result<cv::Mat> DecodeImage(Bytes encoded,
                            Channels channels,
                            const std::string& where,
                            int jpeg_halvings) {
  CHECK(jpeg_halvings >= 0 && jpeg_halvings <= kMostJpegHalvings);
  const std::optional<ImageHeader> header = ReadImageHeader(encoded);
  if (header && header->format == ImageHeader::Format::kJpeg) {
    return DecodeJpeg(encoded, channels, jpeg_halvings, where);
  }
  if (header && header->format == ImageHeader::Format::kPng) {
    return DecodePng(encoded, channels, where);
  }
  if (IsTiff(encoded)) {
    return DecodeTiff(encoded, channels, where);
  }
  if (IsHeif(encoded)) {
    return DecodeHeif(encoded, channels, where);
  }
  return DecodeByLibav(encoded, channels, where);
}

Result<cv::Mat> ReadImage(const std::filesystem::path& file, Channels channels) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> encoded, ReadBytes(file));
  return DecodeImage(encoded, channels, file.string());
}

}  // namespace lararium::image
