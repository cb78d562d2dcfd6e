#pragma once

// Target in which people are drawn in linear light: colour and coverage as 16-bit floats, and
// depth, with several samples per pixel. Private to render.

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "shared/core/status.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/passes/screen_bounds.h"

namespace lararium::render {

class LinearTarget {
 public:
  // Allocates memory if the size or the number of samples changed.
  Status Prepare(const ImageSize& size, int samples);

  // Makes this the target of the following draws, limited to bounds. Within bounds it clears colour
  // and coverage to 0 and depth to far.
  void BindAndClear(const PixelBounds& bounds) const;
  // Averages the samples of each pixel within bounds and stores them in texture().
  void Resolve(const PixelBounds& bounds) const;
  // Reads the resolved picture into a CV_32FC4 image of the full size: red, green, blue, coverage;
  // top row first. Pixels outside bounds are 0.
  void ReadPixels(const PixelBounds& bounds, cv::Mat& rgba) const;
  // The resolved picture, bottom row first as usual in OpenGL.
  uint32_t texture() const { return resolved_.id(); }

 private:
  Status AllocateResolved();
  Status AllocateSampled();
  void FreeSampled();
  bool sampled() const { return samples_ > 1; }

  ImageSize size_;
  int samples_ = 1;  // 1: drawing goes directly into resolved_
  GlTexture resolved_;
  GlRenderbuffer resolved_depth_;
  GlFramebuffer resolved_framebuffer_;
  // Buffers with several samples per pixel; empty if samples_ is 1.
  GlRenderbuffer colour_;
  GlRenderbuffer depth_;
  GlFramebuffer framebuffer_;
};

}  // namespace lararium::render
