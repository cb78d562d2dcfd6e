#pragma once

// Recycles images that are no longer in use, so that a part that publishes one for each
// frame does not allocate.

#include <opencv2/core.hpp>
#include <vector>

namespace lararium::geometry {

class FramePool {
 public:
  // Returns an image of this size and type that only the caller may write until it is published.
  // Its content is undefined.
  cv::Mat Take(int rows, int cols, int type) {
    for (cv::Mat& image : images_) {
      if (image.rows == rows && image.cols == cols && image.type() == type && OnlyOurs(image)) {
        return image;
      }
    }
    cv::Mat fresh(rows, cols, type);
    if (images_.size() < kKept) {
      images_.push_back(fresh);
    }
    return fresh;
  }

 private:
  static constexpr size_t kKept = 16;

  // Reads the count atomically, because other threads release their frames at any time.
  static bool OnlyOurs(const cv::Mat& image) { return CV_XADD(&image.u->refcount, 0) == 1; }

  std::vector<cv::Mat> images_;
};

}  // namespace lararium::geometry
