#pragma once

// Small copies of pictures for somebody beside the visitor, read without waiting for the drawing.

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/render/gl_object.h"
#include "shared/render/render_target.h"

namespace lararium::render {

// On the thread of the context that pictures are drawn in. A copy takes some frames: each step is
// begun when the one before is done.
class PictureMirror {
 public:
  explicit PictureMirror(int most_width) : most_width_(most_width) {}
  ~PictureMirror();
  PictureMirror(const PictureMirror&) = delete;
  PictureMirror& operator=(const PictureMirror&) = delete;

  // Makes what copies of such pictures need, and waits for it: drivers take their time with what
  // they do for the first time.
  void Prepare(const RenderTarget& picture);

  // Tells the graphics device to begin a copy, halved until it is at most as wide. Nothing while
  // one is under way.
  void Begin(const RenderTarget& picture);
  bool under_way() const { return fence_ != nullptr; }

  // The next step, if its time has come; never waits. True once the copy is there: rgba is then
  // CV_8UC4, top row first, allocated anew.
  bool TryFinish(cv::Mat& rgba);

 private:
  struct Level {
    int width = 0;
    int height = 0;
    GlTexture texture;
    GlFramebuffer framebuffer;
  };

  void MakeLevels(int width, int height);
  void Halve(uint32_t from, int width, int height, const Level& level);
  void BeginReading();
  bool StepIsDone();

  int most_width_;
  int width_ = 0;  // of the pictures that levels_ are of
  int height_ = 0;
  std::vector<Level> levels_;  // the last is what is read
  GlBuffer buffer_;
  void* fence_ = nullptr;  // OpenGL's GLsync, of the step under way
  size_t step_ = 0;        // a level; after the last: to where the processor reaches it
};

}  // namespace lararium::render
