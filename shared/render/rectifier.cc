#include "shared/render/rectifier.h"

#include <opencv2/imgproc.hpp>

#include "shared/core/check.h"

namespace lararium::render {

const cv::Mat& Rectifier::Rectify(const cv::Mat& image,
                                  const geometry::CameraModel& camera,
                                  const geometry::CameraModel& display) {
  CHECK(image.type() == CV_8UC3 && image.cols == camera.width && image.rows == camera.height);
  if (whole_.empty() || camera != camera_ || display != display_) {
    camera_ = camera;
    display_ = display;
    FindPixels();
  }
  cv::remap(image, rectified_, whole_, fraction_, cv::INTER_LINEAR);
  return rectified_;
}

void Rectifier::FindPixels() {
  cv::Mat pixels(display_.height, display_.width, CV_32FC2);
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      const Eigen::Vector2d plane((x - display_.cx) / display_.fx, (y - display_.cy) / display_.fy);
      const Eigen::Vector2d pixel = camera_.PixelFromPlane(plane);
      pixels.at<cv::Vec2f>(y, x) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
    }
  }
  cv::convertMaps(pixels, {}, whole_, fraction_, CV_16SC2);
}

}  // namespace lararium::render
