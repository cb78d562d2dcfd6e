#include "shared/render/texture_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "shared/core/check.h"

namespace lararium::render {
namespace {

constexpr std::array<uint8_t, 8> kPngMagic = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

uint32_t BigEndian(const uint8_t* bytes, int count) {
  uint32_t value = 0;
  for (int i = 0; i < count; ++i) {
    value = value << 8 | bytes[i];
  }
  return value;
}

// The first chunk is the header: length, "IHDR", width, height.
std::optional<cv::Size> PngSize(std::span<const uint8_t> bytes) {
  if (bytes.size() < 24 || !std::equal(kPngMagic.begin(), kPngMagic.end(), bytes.begin()) ||
      std::memcmp(bytes.data() + 12, "IHDR", 4) != 0) {
    return std::nullopt;
  }
  const uint32_t width = BigEndian(bytes.data() + 16, 4);
  const uint32_t height = BigEndian(bytes.data() + 20, 4);
  constexpr uint32_t kMost = 0x7fffffff;
  return cv::Size(static_cast<int>(std::min(width, kMost)),
                  static_cast<int>(std::min(height, kMost)));
}

// Segments follow one another until the one that starts a frame.
std::optional<cv::Size> JpegSize(std::span<const uint8_t> bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) {
    return std::nullopt;
  }
  size_t at = 2;
  while (at + 9 <= bytes.size() && bytes[at] == 0xff) {
    const uint8_t marker = bytes[at + 1];
    if (marker == 0xff) {  // padding
      ++at;
      continue;
    }
    const bool starts_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (starts_frame) {
      return cv::Size(static_cast<int>(BigEndian(&bytes[at + 7], 2)),
                      static_cast<int>(BigEndian(&bytes[at + 5], 2)));
    }
    at += 2 + BigEndian(&bytes[at + 2], 2);
  }
  return std::nullopt;
}

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
  const std::span bytes(reinterpret_cast<const uint8_t*>(encoded.data()), encoded.size());
  std::optional<cv::Size> size = PngSize(bytes);
  if (!size) {
    size = JpegSize(bytes);
  }
  if (!size || size->width <= 0 || size->height <= 0) {
    return Status::Error(place, "is no PNG or JPEG image", "give it another image, or none");
  }
  if (size->width > kMaxTextureSide || size->height > kMaxTextureSide) {
    return Status::Error(place,
                         "is an image of " + std::to_string(size->width) + "x" +
                             std::to_string(size->height) + " pixels",
                         "reduce it to at most " + std::to_string(kMaxTextureSide));
  }
  return *size;
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
