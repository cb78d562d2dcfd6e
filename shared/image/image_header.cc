#include "shared/image/image_header.h"

#include <cstring>
#include <string_view>

namespace lararium::image {
namespace {

using Bytes = std::span<const std::byte>;

uint32_t BigEndian(Bytes bytes) {
  uint32_t value = 0;
  for (const std::byte byte : bytes) {
    value = value << 8 | static_cast<uint32_t>(byte);
  }
  return value;
}

uint32_t LittleEndian(Bytes bytes) {
  uint32_t value = 0;
  for (size_t i = bytes.size(); i-- > 0;) {
    value = value << 8 | static_cast<uint32_t>(bytes[i]);
  }
  return value;
}

bool HasAt(Bytes bytes, size_t at, std::string_view text) {
  return at + text.size() <= bytes.size() &&
         std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}

// The first chunk is the header: length, "IHDR", width, height.
std::optional<ImageHeader> ReadPng(Bytes bytes) {
  if (bytes.size() < 24 || !HasAt(bytes, 12, "IHDR")) {
    return std::nullopt;
  }
  return ImageHeader{ImageHeader::Format::kPng, BigEndian(bytes.subspan(16, 4)),
                     BigEndian(bytes.subspan(20, 4))};
}

bool StartsFrame(uint32_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

// Segments precede the one that starts a frame: marker, length, precision, height, width.
std::optional<ImageHeader> ReadJpeg(Bytes bytes) {
  for (size_t at = 2; at + 9 <= bytes.size() && bytes[at] == std::byte{0xff};) {
    const auto marker = static_cast<uint32_t>(bytes[at + 1]);
    if (marker == 0xff) {  // padding
      ++at;
      continue;
    }
    if (StartsFrame(marker)) {
      return ImageHeader{ImageHeader::Format::kJpeg, BigEndian(bytes.subspan(at + 7, 2)),
                         BigEndian(bytes.subspan(at + 5, 2))};
    }
    at += 2 + BigEndian(bytes.subspan(at + 2, 2));
  }
  return std::nullopt;
}

// A negative height means that the top row comes first.
std::optional<ImageHeader> ReadBmp(Bytes bytes) {
  if (bytes.size() < 26) {
    return std::nullopt;
  }
  const uint32_t height = LittleEndian(bytes.subspan(22, 4));
  return ImageHeader{ImageHeader::Format::kBmp, LittleEndian(bytes.subspan(18, 4)),
                     height > 0x80000000u ? 0u - height : height};
}

}  // namespace

std::optional<ImageHeader> ReadImageHeader(Bytes encoded) {
  if (HasAt(encoded, 0, "\x89PNG\r\n\x1a\n")) {
    return ReadPng(encoded);
  }
  if (HasAt(encoded, 0, "\xff\xd8")) {
    return ReadJpeg(encoded);
  }
  if (HasAt(encoded, 0, "BM")) {
    return ReadBmp(encoded);
  }
  return std::nullopt;
}

}  // namespace lararium::image
