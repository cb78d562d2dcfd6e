#include "shared/render/passes/rectifier.h"

#include <opencv2/imgproc.hpp>

#include "shared/core/check.h"
#include "shared/geometry/resampling.h"

namespace lararium::render {

const cv::Mat& Rectifier::Rectify(const cv::Mat& image,
                                  const geometry::CameraModel& camera,
                                  const geometry::CameraModel& display) {
  CHECK(image.cols == camera.width && image.rows == camera.height);
  if (whole_.empty() || camera != camera_ || display != display_) {
    camera_ = camera;
    display_ = display;
    cv::convertMaps(geometry::PixelsSeenBy(camera, display), {}, whole_, fraction_, CV_16SC2);
  }
  cv::remap(image, rectified_, whole_, fraction_, cv::INTER_LINEAR);
  return rectified_;
}

}  // namespace lararium::render
