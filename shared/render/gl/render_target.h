#pragma once

// Target for finished pictures: sRGB-encoded, 8 bits, top row first.

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "shared/core/status.h"
#include "shared/render/gl/gl_object.h"

namespace lararium::render {

class RenderTarget {
 public:
  // Only Overlay needs depth.
  enum class Depth { kNone, kForOverlay };
  static Result<RenderTarget> Create(int width, int height, Depth depth = Depth::kNone);

  int width() const { return width_; }
  int height() const { return height_; }
  // Can be used in ImGui: texture coordinate (0, 0) is the top-left corner.
  uint32_t texture() const { return colour_.id(); }
  uint32_t framebuffer() const { return framebuffer_.id(); }

  // Waits until all drawing is done.
  static void Finish();

  // Waits for drawing and reads the picture. bgr: CV_8UC3; reallocated if its size differs.
  void ReadPixels(cv::Mat& bgr) const;

  // Draws the picture into the window's framebuffer, as large as it fits, with black bars if the
  // proportions differ.
  void Present(int framebuffer_width, int framebuffer_height) const;

  // Copies the picture with its alpha into a framebuffer, whose lower left pixel of the copy is
  // (x, y). The framebuffer may not have several samples for each pixel.
  void CopyTo(uint32_t framebuffer, int x, int y) const;

 private:
  RenderTarget() = default;

  int width_ = 0;
  int height_ = 0;
  GlTexture colour_;
  GlRenderbuffer depth_;  // Depth::kForOverlay
  GlFramebuffer framebuffer_;
  mutable cv::Mat read_;  // RGBA, kept between calls
};

}  // namespace lararium::render
