#include "shared/image/pixel_orientation.h"

#include <array>
#include <cmath>
#include <opencv2/core.hpp>

namespace lararium::image {

PixelOrientation PixelOrientation::FromExif(uint32_t orientation) {
  static constexpr std::array<PixelOrientation, 9> kOrientations = {{{},
                                                                     {},
                                                                     {false, true, false},
                                                                     {false, true, true},
                                                                     {false, false, true},
                                                                     {true, false, false},
                                                                     {true, true, false},
                                                                     {true, true, true},
                                                                     {true, false, true}}};
  return orientation < kOrientations.size() ? kOrientations[orientation] : PixelOrientation();
}

// The matrix maps the stored pixel (x, y) to (a x + c y, b x + d y).
PixelOrientation PixelOrientation::FromDisplayMatrix(std::span<const int32_t, 9> matrix) {
  const double a = matrix[0];
  const double b = matrix[1];
  const double c = matrix[3];
  const double d = matrix[4];
  if (std::abs(a) + std::abs(d) >= std::abs(b) + std::abs(c)) {
    return {false, a < 0.0, d < 0.0};
  }
  return {true, c < 0.0, b < 0.0};
}

void PixelOrientation::Apply(const cv::Mat& stored, cv::Mat& upright) const {
  constexpr int kBoth = -1;
  constexpr int kRows = 0;
  constexpr int kColumns = 1;
  const int reversed = columns_reversed && rows_reversed ? kBoth : rows_reversed ? kRows : kColumns;
  const bool reverses = columns_reversed || rows_reversed;
  if (transposed) {
    cv::transpose(stored, upright);
    if (reverses) {
      cv::flip(upright, upright, reversed);
    }
  } else if (reverses) {
    cv::flip(stored, upright, reversed);
  } else {
    stored.copyTo(upright);
  }
}

}  // namespace lararium::image
