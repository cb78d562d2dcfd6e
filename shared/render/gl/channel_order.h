#pragma once

// Images are BGR, which OpenGL ES cannot upload, and shaders read RGB. Private to render.

#include <opencv2/core/mat.hpp>

namespace lararium::render {

// The image to upload, as RGB or RGBA, in place of one of three or four channels: the image itself
// where reading can swap red and blue, otherwise a copy.
cv::Mat InUploadOrder(const cv::Mat& bgr);

// Makes reading the bound texture swap red and blue, if InUploadOrder() has left them as they were.
void SwapRedAndBlueIfNeeded();

}  // namespace lararium::render
