#pragma once

// Reading pictures, by the libraries that do nothing else: libjpeg-turbo, libpng,
// libtiff, and libav for the rest. (OpenCV's own readers bring GDAL and a hundred libraries more
// into every start of a program.)

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "shared/core/status.h"

namespace lararium::image {

// What comes out, 8 bits of each: colours as they lie in the file (sRGB, nearly always;
// profiles and gamma are not applied), alpha not premultiplied, 255 where there is none.
enum class Channels : uint8_t { kGrey, kBgr, kBgra };

inline constexpr int kMostJpegHalvings = 3;

// Of a PNG, JPEG, BMP, TIFF or WebP, the first one where there are several; never a part of
// one. EXIF's orientation is ignored: a camera's model is that of its sensor. Errors call the
// picture place.
// jpeg_halvings: 0 to kMostJpegHalvings; a JPEG comes so often half as wide and high, rounded up,
// which takes a part of the time. Other pictures are as large as ever.
Result<cv::Mat> DecodeImage(std::span<const std::byte> encoded,
                            Channels channels,
                            const std::string& place,
                            int jpeg_halvings = 0);
Result<cv::Mat> ReadImage(const std::filesystem::path& file, Channels channels);

// More are refused before anything is decoded.
inline constexpr uint64_t kMaxPixels = uint64_t{1} << 28;

}  // namespace lararium::image
