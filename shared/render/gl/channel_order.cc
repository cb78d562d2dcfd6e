#include "shared/render/gl/channel_order.h"

#include <epoxy/gl.h>

namespace lararium::render {

cv::Mat InUploadOrder(const cv::Mat& bgr) { return bgr; }

void SwapRedAndBlueIfNeeded() {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, GL_BLUE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, GL_RED);
}

}  // namespace lararium::render
