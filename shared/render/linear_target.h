#pragma once

// Where people are drawn in linear light: 16-bit floats, coverage and depth, with
// several samples for each pixel. Private to render.

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "shared/core/status.h"
#include "shared/render/gl_object.h"
#include "shared/render/screen_bounds.h"

namespace lararium::render {

class LinearTarget {
 public:
  // Allocates only when the size or the number of samples changes.
  Status Prepare(int width, int height, int samples);

  // Draws go here from now on, within bounds only, where colour and coverage are
  // cleared to nothing and depth to far.
  void BindAndClear(const PixelBounds& bounds) const;
  // Averages the samples of each pixel within bounds into texture().
  void Resolve(const PixelBounds& bounds) const;
  // Copies what was resolved within bounds, and nothing elsewhere, into CV_32FC4: red,
  // green, blue, coverage; the top row first.
  void ReadPixels(const PixelBounds& bounds, cv::Mat& rgba) const;
  // OpenGL's order: the bottom row first.
  uint32_t texture() const { return resolved_.id(); }

 private:
  Status AllocateResolved();
  Status AllocateSampled();

  int width_ = 0;
  int height_ = 0;
  int samples_ = 0;  // 1: drawn into the texture itself
  GlTexture resolved_;
  GlFramebuffer resolved_framebuffer_;
  GlRenderbuffer colour_;
  GlRenderbuffer depth_;
  GlFramebuffer framebuffer_;
};

}  // namespace lararium::render
