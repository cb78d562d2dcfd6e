// Reads TIFF with libtiff, which converts every kind of TIFF to 8-bit red, green, blue and alpha.

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "shared/image/codecs.h"

namespace lararium::image {
namespace {

// A file in memory for libtiff's callbacks. libtiff's errors are not printed.
struct Memory {
  Bytes bytes;
  uint64_t at = 0;
};

Memory& Of(thandle_t handle) { return *static_cast<Memory*>(handle); }

tmsize_t Read(thandle_t handle, void* out, tmsize_t size) {
  Memory& memory = Of(handle);
  const uint64_t left = memory.bytes.size() - std::min<uint64_t>(memory.at, memory.bytes.size());
  const uint64_t count = std::min(left, static_cast<uint64_t>(std::max<tmsize_t>(size, 0)));
  if (count > 0) {
    std::memcpy(out, memory.bytes.data() + memory.at, count);
  }
  memory.at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t Refuse(thandle_t, void*, tmsize_t) { return -1; }

toff_t Seek(thandle_t handle, toff_t offset, int whence) {
  Memory& memory = Of(handle);
  const uint64_t from = whence == SEEK_SET   ? 0
                        : whence == SEEK_CUR ? memory.at
                                             : memory.bytes.size();
  memory.at = from + offset;
  return memory.at;
}

toff_t Size(thandle_t handle) { return Of(handle).bytes.size(); }

int Close(thandle_t) { return 0; }

struct Closer {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};

using TiffPtr = std::unique_ptr<TIFF, Closer>;

// Returns null if the file has no page that can be read.
TiffPtr Open(Memory& memory) {
  static const bool silent = (TIFFSetErrorHandler(nullptr), TIFFSetWarningHandler(nullptr), true);
  static_cast<void>(silent);
  return TiffPtr(
      TIFFClientOpen("picture", "rm", &memory, Read, Refuse, Seek, Close, Size, nullptr, nullptr));
}

std::optional<cv::Size> SizeOf(TIFF* tiff) {
  uint32_t width = 0;
  uint32_t height = 0;
  if (tiff == nullptr || TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width) == 0 ||
      TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height) == 0 || width > INT32_MAX ||
      height > INT32_MAX) {
    return std::nullopt;
  }
  return cv::Size(static_cast<int>(width), static_cast<int>(height));
}

// Ignores the page's orientation, as for EXIF.
bool ReadPixels(TIFF* tiff, cv::Mat& rgba) {
  TIFFRGBAImage page = {};
  std::array<char, 1024> message = {};
  if (TIFFRGBAImageBegin(&page, tiff, /*stop=*/1, message.data()) == 0) {
    return false;
  }
  page.req_orientation = page.orientation;
  const bool whole = TIFFRGBAImageGet(&page, rgba.ptr<uint32_t>(), page.width, page.height) != 0;
  TIFFRGBAImageEnd(&page);
  return whole;
}

}  // namespace

// Accepts both byte orders, and offsets of 32 bits (42) and of 64 bits (43).
bool IsTiff(Bytes encoded) {
  using std::literals::string_view_literals::operator""sv;
  static constexpr std::array kMagic = {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv};
  return std::any_of(kMagic.begin(), kMagic.end(),
                     [&](std::string_view magic) { return StartsWith(encoded, 0, magic); });
}

std::optional<cv::Size> ReadTiffSize(Bytes encoded) {
  Memory memory{encoded};
  const TiffPtr tiff = Open(memory);
  return SizeOf(tiff.get());
}

TiffTraits ReadTiffTraits(Bytes encoded) {
  constexpr int kMostPages = 1000;
  TiffTraits traits;
  Memory memory{encoded};
  const TiffPtr tiff = Open(memory);
  if (tiff == nullptr) {
    return traits;
  }
  uint32_t size = 0;
  const std::byte* profile = nullptr;
  if (TIFFGetField(tiff.get(), TIFFTAG_ICCPROFILE, &size, &profile) == 1 && profile != nullptr) {
    traits.profile.assign(profile, profile + size);
  }
  do {
    uint32_t kind = 0;
    TIFFGetField(tiff.get(), TIFFTAG_SUBFILETYPE, &kind);
    traits.pages += (kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) == 0 ? 1 : 0;
  } while (traits.pages < kMostPages && TIFFReadDirectory(tiff.get()) == 1);
  return traits;
}

Result<cv::Mat> DecodeTiff(Bytes encoded, Channels channels, const std::string& where) {
  Memory memory{encoded};
  const TiffPtr tiff = Open(memory);
  const std::optional<cv::Size> size = SizeOf(tiff.get());
  if (!size) {
    return Damaged(where, "it has no page that can be read");
  }
  std::array<char, 1024> reason = {};
  if (TIFFRGBAImageOK(tiff.get(), reason.data()) == 0) {
    return Status::Error(
        where, std::string("is a TIFF of a kind that is not read (") + reason.data() + ")",
        "save it again with 8 or 16 bits for each channel");
  }
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image,
                            MakeImage(static_cast<uint64_t>(size->width),
                                      static_cast<uint64_t>(size->height), CV_8UC4, where));
  if (!ReadPixels(tiff.get(), image)) {
    return Damaged(where, "its pixels cannot be read");
  }
  if (channels == Channels::kBgra) {
    cv::cvtColor(image, image, cv::COLOR_RGBA2BGRA);
    return image;
  }
  cv::Mat bgr;
  cv::cvtColor(image, bgr, cv::COLOR_RGBA2BGR);
  return Converted(bgr, channels);
}

}  // namespace lararium::image
