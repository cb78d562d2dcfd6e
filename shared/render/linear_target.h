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
  // Allocates where the size or the number of samples is new.
  Status Prepare(const ImageSize& size, int samples);

  // Draws go here from now on, within bounds only, where colour and coverage are
  // cleared to nothing and depth to far.
  void BindAndClear(const PixelBounds& bounds) const;
  // Averages the samples of each pixel within bounds into texture().
  void Resolve(const PixelBounds& bounds) const;
  // Copies what was resolved within bounds, and nothing elsewhere, into CV_32FC4: red,
  // green, blue, coverage; the top row first, of the size drawn.
  void ReadPixels(const PixelBounds& bounds, cv::Mat& rgba) const;
  // OpenGL's order: the bottom row first.
  uint32_t texture() const { return resolved_.id(); }

 private:
  Status AllocateResolved();
  Status AllocateSampled();
  void FreeSampled();
  bool sampled() const { return samples_ > 1; }

  ImageSize size_;
  int samples_ = 1;  // 1: drawn into the texture itself
  GlTexture resolved_;
  GlRenderbuffer resolved_depth_;
  GlFramebuffer resolved_framebuffer_;
  // Of several samples; none otherwise.
  GlRenderbuffer colour_;
  GlRenderbuffer depth_;
  GlFramebuffer framebuffer_;
};

}  // namespace lararium::render
