#include "shared/render/gl/texture_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "shared/core/check.h"
#include "shared/core/srgb.h"
#include "shared/image/decode.h"
#include "shared/image/image_header.h"

namespace lararium::render {
namespace {

// Index: [alpha][encoded colour].
using Table = std::array<std::array<uint8_t, 256>, 256>;

Table MakePremultiplyTable() {
  Table table;
  for (size_t alpha = 0; alpha < 256; ++alpha) {
    for (size_t c = 0; c < 256; ++c) {
      const double linear = LinearFromSrgb(static_cast<double>(c) / 255.0);
      const double encoded = SrgbFromLinear(linear * static_cast<double>(alpha) / 255.0);
      table[alpha][c] = static_cast<uint8_t>(std::lround(255.0 * encoded));
    }
  }
  return table;
}

cv::Size Halved(const cv::Size& size, int halvings) {
  const int most = (1 << halvings) - 1;
  return {(size.width + most) >> halvings, (size.height + most) >> halvings};
}

int LongerSide(const cv::Size& size) { return std::max(size.width, size.height); }

}  // namespace

Result<cv::Size> ReadImageSize(std::span<const std::byte> encoded, const std::string& where) {
  const std::optional<image::ImageHeader> header = image::ReadImageHeader(encoded);
  using Format = image::ImageHeader::Format;
  if (!header || (header->format != Format::kPng && header->format != Format::kJpeg) ||
      header->width == 0 || header->height == 0) {
    return Status::Error(where, "is not a PNG or JPEG image", "use another image, or none");
  }
  if (std::max(header->width, header->height) > uint32_t{kMaxTextureSide}) {
    return Status::Error(where,
                         "is an image of " + std::to_string(header->width) + "x" +
                             std::to_string(header->height) + " pixels",
                         "reduce it to at most " + std::to_string(kMaxTextureSide));
  }
  return cv::Size(static_cast<int>(header->width), static_cast<int>(header->height));
}

Result<cv::Mat> DecodeTexture(std::span<const std::byte> encoded,
                              const std::string& where,
                              int jpeg_halvings) {
  LARARIUM_ASSIGN_OR_RETURN(const cv::Size size, ReadImageSize(encoded, where));
  LARARIUM_ASSIGN_OR_RETURN(
      cv::Mat bgra, image::DecodeImage(encoded, image::Channels::kBgra, where, jpeg_halvings));
  if (bgra.size() != size && bgra.size() != Halved(size, jpeg_halvings)) {
    return Status::Error(where, "is damaged: its header states a different size than its content",
                         "use another image, or none");
  }
  return bgra;
}

void PremultiplySrgb(cv::Mat& bgra) {
  CHECK(bgra.type() == CV_8UC4);
  static const Table table = MakePremultiplyTable();
  for (int y = 0; y < bgra.rows; ++y) {
    for (cv::Vec4b* pixel = bgra.ptr<cv::Vec4b>(y); pixel != bgra.ptr<cv::Vec4b>(y) + bgra.cols;
         ++pixel) {
      if (const uint8_t alpha = (*pixel)[3]; alpha != 255) {
        for (int c = 0; c < 3; ++c) {
          (*pixel)[c] = table[alpha][(*pixel)[c]];
        }
      }
    }
  }
}

Result<cv::Mat> DecodeForUse(std::span<const std::byte> encoded,
                             TextureUse use,
                             int halvings,
                             const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const cv::Size size, ReadImageSize(encoded, where));
  while (halvings > 0 && LongerSide(Halved(size, halvings)) < kLeastReducedSide) {
    --halvings;
  }
  LARARIUM_ASSIGN_OR_RETURN(
      cv::Mat bgra, DecodeTexture(encoded, where, std::min(halvings, image::kMostJpegHalvings)));
  if (use == TextureUse::kColour) {
    PremultiplySrgb(bgra);
  }
  if (const cv::Size halved = Halved(size, halvings); bgra.size() != halved) {
    cv::resize(bgra, bgra, halved, 0, 0, cv::INTER_AREA);
  }
  return bgra;
}

}  // namespace lararium::render
