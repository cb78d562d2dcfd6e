#include "shared/image/image_header.h"

#include "shared/image/codecs.h"

namespace lararium::image {
namespace {

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

// The first chunk is the header: length, "IHDR", width, height.
std::optional<ImageHeader> ReadPng(Bytes bytes) {
  if (bytes.size() < 24 || !StartsWith(bytes, 12, "IHDR")) {
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

// The first chunk is a lossy picture, a lossless one, or a header of several chunks.
std::optional<ImageHeader> ReadWebp(Bytes bytes) {
  constexpr size_t kContent = 20;  // After "RIFF", size, "WEBP", chunk, size.
  if (bytes.size() < kContent + 10) {
    return std::nullopt;
  }
  const auto number = [&](size_t at, size_t size) {
    return LittleEndian(bytes.subspan(kContent + at, size));
  };
  constexpr uint32_t k14Bits = 0x3fff;
  if (StartsWith(bytes, 12, "VP8 ") && StartsWith(bytes, kContent + 3, "\x9d\x01\x2a")) {
    return ImageHeader{ImageHeader::Format::kWebp, number(6, 2) & k14Bits, number(8, 2) & k14Bits};
  }
  if (StartsWith(bytes, 12, "VP8L") && StartsWith(bytes, kContent, "\x2f")) {
    return ImageHeader{ImageHeader::Format::kWebp, (number(1, 4) & k14Bits) + 1,
                       (number(1, 4) >> 14 & k14Bits) + 1};
  }
  if (StartsWith(bytes, 12, "VP8X")) {
    return ImageHeader{ImageHeader::Format::kWebp, number(4, 3) + 1, number(7, 3) + 1};
  }
  return std::nullopt;
}

// A Targa file starts without a name of its format (Truevision TGA 2.0), so every field of the
// header has to make sense.
std::optional<ImageHeader> ReadTga(Bytes bytes) {
  constexpr size_t kHeader = 18;
  if (bytes.size() < kHeader) {
    return std::nullopt;
  }
  const auto number = [&](size_t at, size_t size) { return LittleEndian(bytes.subspan(at, size)); };
  const uint32_t has_palette = number(1, 1);
  const uint32_t type = number(2, 1);
  const uint32_t kind = type & ~8u;  // Eight more: in runs of equal pixels.
  const uint32_t palette_size = number(5, 2);
  const uint32_t depth = number(16, 1);
  const ImageHeader header{ImageHeader::Format::kTga, number(12, 2), number(14, 2)};
  const bool palette_fits = has_palette == 1   ? palette_size > 0
                            : has_palette == 0 ? palette_size == 0 && kind != 1
                                               : false;
  const bool depth_fits = kind == 2 ? depth == 15 || depth == 16 || depth == 24 || depth == 32
                                    : depth == 8 || (kind == 3 && depth == 16);
  const bool plain = (number(17, 1) & 0xc0u) == 0;  // The rows are not interleaved.
  return kind >= 1 && kind <= 3 && (type & ~0x0bu) == 0 && palette_fits && depth_fits && plain &&
                 header.width > 0 && header.height > 0
             ? std::optional(header)
             : std::nullopt;
}

std::optional<ImageHeader> Header(ImageHeader::Format format, std::optional<cv::Size> size) {
  return size ? std::optional(ImageHeader{format, static_cast<uint32_t>(size->width),
                                          static_cast<uint32_t>(size->height)})
              : std::nullopt;
}

}  // namespace

std::optional<ImageHeader> ReadImageHeader(Bytes encoded) {
  if (StartsWith(encoded, 0, "\x89PNG\r\n\x1a\n")) {
    return ReadPng(encoded);
  }
  if (StartsWith(encoded, 0, "\xff\xd8")) {
    return ReadJpeg(encoded);
  }
  if (StartsWith(encoded, 0, "BM")) {
    return ReadBmp(encoded);
  }
  if (StartsWith(encoded, 0, "RIFF") && StartsWith(encoded, 8, "WEBP")) {
    return ReadWebp(encoded);
  }
  if (StartsWith(encoded, 0, "8BPS") && encoded.size() >= 26) {
    return ImageHeader{ImageHeader::Format::kPsd, BigEndian(encoded.subspan(18, 4)),
                       BigEndian(encoded.subspan(14, 4))};
  }
  if (StartsWith(encoded, 0, "DDS ") && encoded.size() >= 20) {
    return ImageHeader{ImageHeader::Format::kDds, LittleEndian(encoded.subspan(16, 4)),
                       LittleEndian(encoded.subspan(12, 4))};
  }
  if (IsTiff(encoded)) {
    return Header(ImageHeader::Format::kTiff, ReadTiffSize(encoded));
  }
  if (IsHeif(encoded)) {
    return Header(ImageHeader::Format::kHeif, ReadHeifSize(encoded));
  }
  return ReadTga(encoded);
}

}  // namespace lararium::image
