#pragma once

// Draws ImGui's frames, of each only where it differs from the one before, and nothing that
// something opaque hides.

#include <imgui.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "editor/panels/frame_damage.h"
#include "shared/render/gl_object.h"

namespace lararium::app {

// For one OpenGL context, which is current in all that is called, with ImGui's back end
// started. Keeps a picture of the window, for a window's own does not outlast a swap.
class FramePainter {
 public:
  // background: sRGB-encoded, where no window of ImGui's is. False where the frame looks like the
  // last one.
  bool Paint(ImDrawData& frame, const glm::vec3& background);
  // Copies the whole picture into a framebuffer of the same size; 0 is the window's.
  void CopyInto(uint32_t framebuffer) const;
  // The next frame is painted whole: after ImGui's own textures became others.
  void Forget() { damage_.Forget(); }

 private:
  void SetSize(int width, int height);
  // The frame's commands as they were.
  void Restore(ImDrawData& frame) const;
  void PaintRect(ImDrawData& frame, const panels::DamageRect& rect, const glm::vec3& background);

  panels::FrameDamage damage_;
  int width_ = 0, height_ = 0;  // pixels
  render::GlTexture colour_;
  render::GlFramebuffer framebuffer_;
  std::vector<ImDrawCmd> commands_;  // the frame's, while they are narrowed
};

}  // namespace lararium::app
