#pragma once

// Reads the size that an encoded image declares, so that nothing too large is decoded.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lararium::image {

struct ImageHeader {
  enum class Format { kPng, kJpeg, kBmp, kTiff, kWebp, kHeif, kPsd, kDds, kTga };

  Format format = Format::kPng;
  uint32_t width = 0;  // Pixels, as declared; any value is possible.
  uint32_t height = 0;

  friend bool operator==(const ImageHeader&, const ImageHeader&) = default;
};

// Reads the header of a PNG (ISO/IEC 15948, 11.2.2), a JPEG (ITU-T T.81, B.1 and B.2.2), a Windows
// bitmap, a TIFF (its first page), a WebP (RFC 9649), where libheif is installed of a HEIC or AVIF,
// or of a file of Photoshop, DirectDraw or Targa, in which models keep textures. Returns nullopt
// for other data, and for data that end before the size.
std::optional<ImageHeader> ReadImageHeader(std::span<const std::byte> encoded);

}  // namespace lararium::image
