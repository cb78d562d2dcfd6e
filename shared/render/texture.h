#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "shared/render/gl_object.h"

namespace lararium::render {

// An image on the GPU.
class Texture {
 public:
  // bgr: CV_8UC3, not empty. Storage is kept while the size stays the same. Shaders see the
  // numbers as they are.
  void Upload(const cv::Mat& bgr);

  // 0 before the first upload. Coordinate (0, 0) is the top-left corner.
  uint32_t id() const { return texture_.id(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  GlTexture texture_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace lararium::render
