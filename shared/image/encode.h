#pragma once

// Writes pictures of 8 bits: CV_8UC1 grey, CV_8UC3 BGR and, in PNG only, CV_8UC4 BGRA.

#include <cstddef>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/core/status.h"

namespace lararium::image {

// At most 65 500 pixels wide and high; quality 1 to 100. Chroma has half the resolution, as in
// cameras' files.
Result<std::vector<std::byte>> EncodeJpeg(const cv::Mat& image, int quality);

// compression: zlib's level, 1 (fast) to 9 (small).
Result<std::vector<std::byte>> EncodePng(const cv::Mat& image, int compression = 6);

// Chooses the format by the file extension: .png, or .jpg and .jpeg with jpeg_quality. Replaces the
// file atomically.
Status WriteImage(const std::filesystem::path& file, const cv::Mat& image, int jpeg_quality = 92);

}  // namespace lararium::image
