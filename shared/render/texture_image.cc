#include "shared/render/texture_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "shared/core/check.h"
#include "shared/core/image_header.h"

namespace lararium::render {
namespace {

// 8-bit BGRA of whatever the decoder gives: grey, colour, with alpha or without,
// 8 or 16 bits.
std::optional<cv::Mat> ToBgra(cv::Mat image) {
  if (image.depth() == CV_16U) {
    image.convertTo(image, CV_8U, 1.0 / 257.0);
  }
  if (image.depth() != CV_8U) {
    return std::nullopt;
  }
  cv::Mat bgra;
  switch (image.channels()) {
    case 1:
      cv::cvtColor(image, bgra, cv::COLOR_GRAY2BGRA);
      return bgra;
    case 3:
      cv::cvtColor(image, bgra, cv::COLOR_BGR2BGRA);
      return bgra;
    case 4:
      return image;
    default:
      return std::nullopt;
  }
}

double LinearFromSrgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double SrgbFromLinear(double c) {
  return c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

// [alpha][encoded colour]
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

}  // namespace

Result<cv::Size> ReadImageSize(std::span<const std::byte> encoded, const std::string& place) {
  const std::optional<ImageHeader> header = ReadImageHeader(encoded);
  if (!header || header->format == ImageHeader::Format::kBmp || header->width == 0 ||
      header->height == 0) {
    return Status::Error(place, "is no PNG or JPEG image", "give it another image, or none");
  }
  if (std::max(header->width, header->height) > uint32_t{kMaxTextureSide}) {
    return Status::Error(place,
                         "is an image of " + std::to_string(header->width) + "x" +
                             std::to_string(header->height) + " pixels",
                         "reduce it to at most " + std::to_string(kMaxTextureSide));
  }
  return cv::Size(static_cast<int>(header->width), static_cast<int>(header->height));
}

Result<cv::Mat> DecodeTexture(std::span<const std::byte> encoded, const std::string& place) {
  LARARIUM_ASSIGN_OR_RETURN(const cv::Size size, ReadImageSize(encoded, place));
  cv::Mat image;
  try {
    const cv::Mat bytes(1, static_cast<int>(encoded.size()), CV_8U,
                        const_cast<std::byte*>(encoded.data()));
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  const std::optional<cv::Mat> bgra =
      image.empty() || image.size() != size ? std::nullopt : ToBgra(image);
  if (!bgra) {
    return Status::Error(place, "the image is damaged or cut short",
                         "bake or export the figure again");
  }
  return *bgra;
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

}  // namespace lararium::render
