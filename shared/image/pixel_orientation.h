#pragma once

// How the stored rows and columns of a picture lie in the upright picture: EXIF's orientation of
// photographs and the display matrix of films.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

namespace lararium::image {

// The stored picture becomes upright by exchanging its rows with its columns, then by reversing
// its columns, its rows, or both.
struct PixelOrientation {
  bool transposed = false;
  bool columns_reversed = false;
  bool rows_reversed = false;

  friend bool operator==(const PixelOrientation&, const PixelOrientation&) = default;

  // orientation: EXIF's number, 1 to 8 (JEITA CP-3451, tag 0x0112). Any other number is upright.
  static PixelOrientation FromExif(uint32_t orientation);
  // matrix: the nine numbers of a film's display matrix (ISO/IEC 14496-12, 8.3.2). A turn that is
  // no multiple of 90 degrees becomes the nearest one.
  static PixelOrientation FromDisplayMatrix(std::span<const int32_t, 9> matrix);

  bool upright() const { return *this == PixelOrientation(); }
  // By how many right angles, clockwise, the stored picture is turned. A mirrored one counts as the
  // picture before it was mirrored left to right.
  int quarter_turns() const {
    return transposed ? (columns_reversed ? 1 : 3) : (rows_reversed ? 2 : 0);
  }
  cv::Size SizeOf(cv::Size stored) const {
    return transposed ? cv::Size(stored.height, stored.width) : stored;
  }
  // upright: another image than `stored`. Its memory is reused if it has the right size and type.
  void Apply(const cv::Mat& stored, cv::Mat& upright) const;
};

}  // namespace lararium::image
