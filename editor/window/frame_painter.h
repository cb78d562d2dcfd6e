#pragma once

// Draws ImGui's frames: only the parts that differ from the previous frame, and nothing that is
// hidden by something opaque.

#include <imgui.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "editor/panels/widgets/frame_damage.h"
#include "shared/render/gl/gl_object.h"

namespace lararium::editor {

// For one OpenGL context, which must be current in every call, with ImGui's back end started. Keeps
// its own copy of the window's picture, because the window's buffer does not survive a swap.
class FramePainter {
 public:
  // background: sRGB-encoded colour outside ImGui's windows. Returns false if the frame looks like
  // the last one.
  bool Paint(ImDrawData& frame, const glm::vec3& background);
  // Copies the whole picture into a framebuffer of the same size; 0 is the window's.
  void CopyInto(uint32_t framebuffer) const;
  // Paints the next frame completely. Call after ImGui's textures were replaced.
  void Forget() { damage_.Forget(); }

 private:
  void SetSize(int width, int height);
  // Restores the frame's original commands.
  void Restore(ImDrawData& frame) const;
  void PaintRect(ImDrawData& frame, const panels::DamageRect& rect, const glm::vec3& background);

  panels::FrameDamage damage_;
  int width_ = 0, height_ = 0;  // pixels
  render::GlTexture colour_;
  render::GlFramebuffer framebuffer_;
  std::vector<ImDrawCmd> commands_;  // The frame's original commands.
};

}  // namespace lararium::editor
