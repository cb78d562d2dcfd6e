#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "shared/render/gl/gl_object.h"

namespace lararium::render {

// An image on the GPU.
class Texture {
 public:
  // bgr: CV_8UC3, or CV_32FC4 with a fourth channel, which is stored as half floats; not empty, and
  // of one type in all uploads. Storage is reused while the size stays the same. Shaders read the
  // values without conversion from sRGB.
  void Upload(const cv::Mat& bgr);

  // 0 before the first upload. Coordinate (0, 0) is the top-left corner.
  uint32_t id() const { return texture_.id(); }
  // Identifies the content. Each upload gives a version that no other texture has had.
  uint32_t version() const { return version_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  GlTexture texture_;
  uint32_t version_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace lararium::render
