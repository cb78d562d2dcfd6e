#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace lararium::geometry {

// One image of a camera, video or folder. Immutable once published; copies share the pixels.
struct Frame {
  int64_t index = -1;         // counts from 0 within its source
  double capture_time = 0.0;  // seconds, monotonic within the source
  cv::Mat bgr;                // CV_8UC3, sRGB-encoded, raw (distorted)
  cv::Mat grey;               // CV_8UC1, the same image

  bool empty() const { return bgr.empty(); }
};

}  // namespace lararium::geometry
