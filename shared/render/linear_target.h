#pragma once

// Where a picture is composed in linear light: 16-bit floats and depth, with
// several samples for each pixel. Private to render.

#include <cstdint>

#include "shared/core/status.h"
#include "shared/render/gl_object.h"

namespace lararium::render {

class LinearTarget {
 public:
  // Allocates only when the size or the number of samples changes.
  Status Prepare(int width, int height, int samples);

  // Draws go here from now on; clears colour to black and depth to far.
  void BindAndClear() const;
  // Averages the samples of each pixel into texture().
  void Resolve() const;
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
