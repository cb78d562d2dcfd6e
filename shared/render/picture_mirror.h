#pragma once

// Small copies of pictures for somebody beside the visitor, read without waiting for the drawing.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/render/gl_object.h"
#include "shared/render/render_target.h"

namespace lararium::render {

// On the thread of the context that pictures are drawn in. Makes what it needs when it is first
// used.
class PictureMirror {
 public:
  explicit PictureMirror(int most_width) : most_width_(most_width) {}
  ~PictureMirror();
  PictureMirror(const PictureMirror&) = delete;
  PictureMirror& operator=(const PictureMirror&) = delete;

  // Tells the graphics device to halve the picture until it is at most as wide, and to copy it to
  // where the processor reaches it. Nothing while one is under way.
  void Begin(const RenderTarget& picture);
  bool under_way() const { return fence_ != nullptr; }

  // True once the copy is there; never waits. rgba: CV_8UC4, top row first, allocated anew.
  bool TryFinish(cv::Mat& rgba);

 private:
  struct Level {
    int width = 0;
    int height = 0;
    GlTexture texture;
    GlFramebuffer framebuffer;
  };

  void MakeLevels(int width, int height);

  int most_width_;
  int width_ = 0;  // of the pictures that levels_ are of
  int height_ = 0;
  std::vector<Level> levels_;  // the last is what is read
  GlBuffer buffer_;
  void* fence_ = nullptr;  // OpenGL's GLsync
};

}  // namespace lararium::render
