#include "shared/geometry/resampling.h"

#include "shared/core/parallel.h"

namespace lararium::geometry {

cv::Mat PixelsSeenBy(const CameraModel& from, const CameraModel& to) {
  cv::Mat pixels(to.height, to.width, CV_32FC2);
  ParallelFor(static_cast<size_t>(to.height), [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < to.width; ++x) {
      const Eigen::Vector2d pixel = from.PixelFromPlane(to.PlaneFromPixel({x, y}));
      pixels.at<cv::Vec2f>(y, x) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
    }
  });
  return pixels;
}

}  // namespace lararium::geometry
