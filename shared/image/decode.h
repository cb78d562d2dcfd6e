#pragma once

// Reads pictures with libraries for single formats: libjpeg-turbo, libpng, libtiff, libheif where
// it is installed, and libav for the rest. (OpenCV's own readers load GDAL and a hundred further
// libraries at every start of a program.)

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "shared/core/status.h"

namespace lararium::image {

// The channels of a decoded image, 8 bits each. Colours are as stored in the file (almost always
// sRGB; profiles and gamma are not applied). Alpha is not premultiplied, and 255 if the file has
// none.
enum class Channels : uint8_t { kGrey, kBgr, kBgra };

inline constexpr int kMostJpegHalvings = 3;

// Decodes a PNG, JPEG, BMP, TIFF, WebP, HEIC, AVIF or JPEG XL; of several pictures in a file, the
// first. Incomplete pictures are errors. The orientation of EXIF data is ignored; HEIC, AVIF and
// JPEG XL state theirs otherwise and are upright. Errors call the picture `where`. jpeg_halvings, 0
// to kMostJpegHalvings: how often the width and height of a JPEG are halved, rounded up, which
// saves time. Other formats keep their size.
Result<cv::Mat> DecodeImage(std::span<const std::byte> encoded,
                            Channels channels,
                            const std::string& where,
                            int jpeg_halvings = 0);
Result<cv::Mat> ReadImage(const std::filesystem::path& file, Channels channels);

// Larger pictures are refused before decoding.
inline constexpr uint64_t kMaxPixels = uint64_t{1} << 28;

}  // namespace lararium::image
