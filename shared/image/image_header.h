#pragma once

// What an encoded image says of itself, so that nothing is decoded that would not fit.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lararium::image {

struct ImageHeader {
  enum class Format { kPng, kJpeg, kBmp };

  Format format = Format::kPng;
  uint32_t width = 0;  // pixels, as it claims: anything
  uint32_t height = 0;

  friend bool operator==(const ImageHeader&, const ImageHeader&) = default;
};

// Of a PNG (ISO/IEC 15948, 11.2.2), a JPEG (ITU-T T.81, B.1 and B.2.2) or a Windows bitmap;
// nullopt for anything else, and where it is cut short before its size.
std::optional<ImageHeader> ReadImageHeader(std::span<const std::byte> encoded);

}  // namespace lararium::image
