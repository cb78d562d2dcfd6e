#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <vector>

#include "shared/core/check.h"

namespace lararium::test {

// Encodes an image as a PNG file.
inline std::vector<std::byte> Png(const cv::Mat& image) {
  std::vector<uchar> png;
  CHECK(cv::imencode(".png", image, png));
  const auto bytes = std::as_bytes(std::span(png));
  return {bytes.begin(), bytes.end()};
}

}  // namespace lararium::test
