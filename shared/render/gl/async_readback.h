#pragma once

// Makes small copies of pictures (for the staff's mirror, for example) without waiting for drawing.

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/render_target.h"

namespace lararium::render {

// Use it on the thread of the context that pictures are drawn in. A copy takes several frames: each
// step begins when the one before is done.
class AsyncReadback {
 public:
  explicit AsyncReadback(int most_width) : most_width_(most_width) {}
  ~AsyncReadback();
  AsyncReadback(const AsyncReadback&) = delete;
  AsyncReadback& operator=(const AsyncReadback&) = delete;

  // Allocates everything for pictures of this size and waits once until it has been used: drivers
  // are slow when they do something for the first time.
  void Prepare(const RenderTarget& picture);

  // Begins a copy, halved in size until it is at most most_width wide. Does nothing while a copy is
  // in progress.
  void Begin(const RenderTarget& picture);
  bool under_way() const { return fence_ != nullptr; }

  // Performs the next step if the one before is done; never waits. Returns true when the copy is
  // complete: rgba is then a newly allocated CV_8UC4 image, top row first.
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
  int width_ = 0;  // size of the pictures that levels_ were made for
  int height_ = 0;
  std::vector<Level> levels_;  // the last one is read back
  GlBuffer buffer_;
  void* fence_ = nullptr;  // OpenGL's GLsync of the current step; nullptr: no copy in progress
  size_t step_ = 0;        // index into levels_; levels_.size(): the transfer into buffer_
};

}  // namespace lararium::render
