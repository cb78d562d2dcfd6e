#pragma once

// Writing pictures of 8 bits: CV_8UC1 grey, CV_8UC3 BGR and, as PNG alone, CV_8UC4 BGRA.

#include <cstddef>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/core/status.h"

namespace lararium::image {

// At most 65 500 pixels wide and high; quality 1 to 100. Colours at half the resolution, as
// cameras write them.
Result<std::vector<std::byte>> EncodeJpeg(const cv::Mat& image, int quality);

// compression: zlib's, 1 (fast) to 9 (small).
Result<std::vector<std::byte>> EncodePng(const cv::Mat& image, int compression = 6);

// As its ending says: .png, .jpg or .jpeg, of that quality. Replaces the file as a whole.
Status WriteImage(const std::filesystem::path& file, const cv::Mat& image, int jpeg_quality = 92);

}  // namespace lararium::image
