#include "shared/capture/exif.h"

#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/core/file.h"
#include "shared/image/decode.h"

// Exchangeable image file format for digital still cameras (JEITA CP-3451):
// fields of the TIFF structure in a JPEG's APP1 segment and at other places of other formats.

namespace lararium::capture {
namespace {

constexpr uint16_t kMake = 0x010f;         // ASCII
constexpr uint16_t kModel = 0x0110;        // ASCII
constexpr uint16_t kOrientation = 0x0112;  // SHORT, 1 to 8
constexpr uint16_t kExifDirectory = 0x8769;
constexpr uint16_t kFocalLength = 0x920a;            // RATIONAL, millimetres
constexpr uint16_t kFocalLengthIn35mmFilm = 0xa405;  // SHORT
constexpr uint16_t kExposureTime = 0x829a;           // RATIONAL, seconds
constexpr uint16_t kFNumber = 0x829d;                // RATIONAL
constexpr uint16_t kIsoSpeed = 0x8827;               // SHORT
constexpr double kFilmDiagonal = 43.2666153;         // millimetres, of 36 x 24

using Bytes = std::span<const std::byte>;

std::optional<uint32_t> BigEndian16(Bytes bytes, size_t at) {
  if (bytes.size() < 2 || at > bytes.size() - 2) {
    return std::nullopt;
  }
  return std::to_integer<uint32_t>(bytes[at]) << 8 | std::to_integer<uint32_t>(bytes[at + 1]);
}

// A TIFF structure with checked access.
class Tiff {
 public:
  static std::optional<Tiff> Open(Bytes bytes) {
    const std::optional<uint32_t> order = BigEndian16(bytes, 0);
    if (order != 0x4949 && order != 0x4d4d) {
      return std::nullopt;
    }
    return Tiff(bytes, order == 0x4949);
  }

  std::optional<uint32_t> U16(size_t at) const {
    const std::optional<uint32_t> value = BigEndian16(bytes_, at);
    if (!value || !little_endian_) {
      return value;
    }
    return (*value & 0xff) << 8 | *value >> 8;
  }
  std::optional<uint32_t> U32(size_t at) const {
    const std::optional<uint32_t> first = U16(at);
    const std::optional<uint32_t> second = first ? U16(at + 2) : std::nullopt;
    if (!second) {
      return std::nullopt;
    }
    return little_endian_ ? *second << 16 | *first : *first << 16 | *second;
  }

  // Returns the text of a tag in the directory at an offset, up to its first NUL; empty if there is
  // none.
  std::string Text(uint32_t directory, uint16_t tag) const {
    const auto value = FindValue(directory, tag);
    const uint32_t count = value ? U32(*value - 4).value_or(0) : 0;
    const auto offset = count > 4 ? U32(*value) : std::nullopt;
    const size_t at = offset ? *offset : value.value_or(0);
    if (count == 0 || at >= bytes_.size() || count > bytes_.size() - at) {
      return {};
    }
    const std::string text(reinterpret_cast<const char*>(bytes_.data()) + at, count);
    return text.substr(0, text.find('\0'));
  }

  // Returns the offset of the value of a tag in the directory at an offset.
  std::optional<size_t> FindValue(uint32_t directory, uint16_t tag) const {
    const uint32_t count = U16(directory).value_or(0);
    for (uint32_t i = 0; i < count; ++i) {
      const size_t entry = size_t{directory} + 2 + size_t{12} * i;
      if (U16(entry) == tag) {
        return entry + 8;
      }
    }
    return std::nullopt;
  }

 private:
  Tiff(Bytes bytes, bool little_endian) : bytes_(bytes), little_endian_(little_endian) {}

  Bytes bytes_;
  bool little_endian_;
};

// The Exif directory of a TIFF structure.
class ExifDirectory {
 public:
  static std::optional<ExifDirectory> Open(Bytes exif) {
    const std::optional<Tiff> tiff = Tiff::Open(exif);
    if (!tiff) {
      return std::nullopt;
    }
    const uint32_t first = tiff->U32(4).value_or(0);
    const auto pointer = tiff->FindValue(first, kExifDirectory);
    const auto offset = pointer ? tiff->U32(*pointer) : std::nullopt;
    return offset ? std::optional(ExifDirectory(*tiff, first, *offset)) : std::nullopt;
  }

  // The text of a tag in the first directory.
  std::string Text(uint16_t tag) const { return tiff_.Text(first_, tag); }

  std::optional<uint32_t> Short(uint16_t tag) const {
    const auto value = tiff_.FindValue(offset_, tag);
    return value ? tiff_.U16(*value) : std::nullopt;
  }
  // Returns a rational number above 0.
  std::optional<double> Rational(uint16_t tag) const {
    const auto value = tiff_.FindValue(offset_, tag);
    const auto at = value ? tiff_.U32(*value) : std::nullopt;
    const auto above = at ? tiff_.U32(*at) : std::nullopt;
    const auto below = at ? tiff_.U32(size_t{*at} + 4) : std::nullopt;
    if (above.value_or(0) == 0 || below.value_or(0) == 0) {
      return std::nullopt;
    }
    return static_cast<double>(*above) / *below;
  }

 private:
  ExifDirectory(const Tiff& tiff, uint32_t first, uint32_t offset)
      : tiff_(tiff), first_(first), offset_(offset) {}

  Tiff tiff_;
  uint32_t first_;
  uint32_t offset_;
};

using std::literals::string_view_literals::operator""sv;

constexpr std::string_view kSignature = "Exif\0\0"sv;

bool HasAt(Bytes bytes, size_t at, std::string_view text) {
  return at <= bytes.size() && text.size() <= bytes.size() - at &&
         std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}

bool IsHeif(Bytes file) { return HasAt(file, 4, "ftyp"); }

// Searches the segments before the image data.
Bytes FindInJpeg(Bytes jpeg) {
  size_t at = 2;
  while (const std::optional<uint32_t> marker = BigEndian16(jpeg, at)) {
    const uint32_t length = BigEndian16(jpeg, at + 2).value_or(0);
    if (*marker < 0xff00 || *marker == 0xffda || length < 2 || length > jpeg.size() - at - 2) {
      return {};
    }
    const Bytes content = jpeg.subspan(at + 4, length - 2);
    if (*marker == 0xffe1 && HasAt(content, 0, kSignature)) {
      return content.subspan(kSignature.size());
    }
    at += 2 + length;
  }
  return {};
}

// Searches the chunks of a PNG (size, name, content, checksum; the size is big-endian) or of a WebP
// (name, size, content, padded to an even size; the size is little-endian).
Bytes FindInChunks(Bytes file, size_t first, bool png) {
  for (size_t at = first; at <= file.size() && file.size() - at >= 8;) {
    uint32_t size = 0;
    for (size_t i = 0; i < 4; ++i) {
      const auto byte = std::to_integer<uint32_t>(file[png ? at + i : at + 7 - i]);
      size = size << 8 | byte;
    }
    const Bytes content = file.subspan(at + 8);
    if (size > content.size()) {
      return {};
    }
    if (HasAt(file, png ? at + 4 : at, png ? "eXIf" : "EXIF")) {
      const Bytes exif = content.first(size);
      return HasAt(exif, 0, kSignature) ? exif.subspan(kSignature.size()) : exif;
    }
    at += png ? size_t{12} + size : size_t{8} + size + size % 2;
  }
  return {};
}

// Returns the TIFF structure with the EXIF data; empty if there is none. In HEIC it is an item
// whose place other items tell; its signature leads there too.
Bytes FindExif(Bytes file) {
  if (HasAt(file, 0, "\xff\xd8")) {
    return FindInJpeg(file);
  }
  if (HasAt(file, 0, "\x89PNG\r\n\x1a\n")) {
    return FindInChunks(file, 8, true);
  }
  if (HasAt(file, 0, "RIFF") && HasAt(file, 8, "WEBP")) {
    return FindInChunks(file, 12, false);
  }
  if (IsHeif(file)) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    for (const std::string_view order : {"II*\0"sv, "MM\0*"sv}) {
      const size_t at = text.find(std::string(kSignature).append(order));
      if (at != std::string_view::npos) {
        return file.subspan(at + kSignature.size());
      }
    }
    return {};
  }
  return file;  // A TIFF, or nothing that Tiff::Open accepts.
}

}  // namespace

std::optional<uint32_t> FindFocalLengthIn35mmFilm(Bytes file) {
  const auto exif = ExifDirectory::Open(FindExif(file));
  const uint32_t focal = exif ? exif->Short(kFocalLengthIn35mmFilm).value_or(0) : 0;
  return focal == 0 ? std::nullopt : std::optional(focal);
}

std::string FindCameraName(Bytes file) {
  const auto exif = ExifDirectory::Open(FindExif(file));
  if (!exif) {
    return {};
  }
  std::string name = exif->Text(kMake) + exif->Text(kModel);
  for (const std::optional<double> focal :
       {exif->Rational(kFocalLength), std::optional<double>(FindFocalLengthIn35mmFilm(file))}) {
    name += focal ? "," + std::to_string(*focal) : "";
  }
  return name;
}

image::PixelOrientation FindOrientation(Bytes file) {
  const auto tiff = IsHeif(file) ? std::nullopt : Tiff::Open(FindExif(file));
  const auto value = tiff ? tiff->FindValue(tiff->U32(4).value_or(0), kOrientation) : std::nullopt;
  return image::PixelOrientation::FromExif(value ? tiff->U16(*value).value_or(0) : 0);
}

std::optional<double> FindExposure(Bytes file) {
  const auto exif = ExifDirectory::Open(FindExif(file));
  const auto seconds = exif ? exif->Rational(kExposureTime) : std::nullopt;
  if (!seconds) {
    return std::nullopt;
  }
  const double aperture = exif->Rational(kFNumber).value_or(1.0);
  const uint32_t iso = exif->Short(kIsoSpeed).value_or(0);
  return *seconds / (aperture * aperture) * (iso > 0 ? iso / 100.0 : 1.0);
}

double FocalPixels(uint32_t focal_in_35mm_film, int width, int height) {
  return focal_in_35mm_film * std::hypot(width, height) / kFilmDiagonal;
}

std::optional<double> ExifExposure(const std::filesystem::path& file) {
  const Result<MappedFile> mapped = MappedFile::Open(file);
  return mapped.ok() ? FindExposure(mapped->bytes()) : std::nullopt;
}

Result<cv::Mat> ReadPhotograph(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> encoded, ReadBytes(file));
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat bgr,
                            image::DecodeImage(encoded, image::Channels::kBgr, file.string()));
  const image::PixelOrientation orientation = FindOrientation(encoded);
  if (orientation.upright()) {
    return bgr;
  }
  cv::Mat upright;
  orientation.Apply(bgr, upright);
  return upright;
}

}  // namespace lararium::capture
