#include "shared/render/gl/channel_order.h"

#include <opencv2/imgproc.hpp>

// WebGL has no texture swizzles.

namespace lararium::render {

cv::Mat InUploadOrder(const cv::Mat& bgr) {
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, bgr.channels() == 3 ? cv::COLOR_BGR2RGB : cv::COLOR_BGRA2RGBA);
  return rgb;
}

void SwapRedAndBlueIfNeeded() {}

}  // namespace lararium::render
