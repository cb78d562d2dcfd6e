#include "editor/window/frame_painter.h"

#include <epoxy/gl.h>
// epoxy first: ImGui's back end must not bring its own OpenGL headers.
#include <imgui_impl_opengl3.h>

#include <cmath>
#include <optional>

#include "editor/panels/widgets/frame_cover.h"

namespace lararium::editor {
namespace {

template <typename Visit>
void ForEachCommand(ImDrawData& frame, const Visit& visit) {
  for (int i = 0; i < frame.CmdListsCount; ++i) {
    for (ImDrawCmd& command : frame.CmdLists[i]->CmdBuffer) {
      visit(command);
    }
  }
}

// Removes from the frame's commands everything below the cover, and the cover itself.
void SkipHidden(ImDrawData& frame, const panels::FrameCover& cover) {
  for (int i = 0; i <= cover.list; ++i) {
    ImVector<ImDrawCmd>& commands = frame.CmdLists[i]->CmdBuffer;
    const int hidden = i < cover.list ? commands.Size : cover.command;
    for (int k = 0; k < hidden; ++k) {
      commands[k].ElemCount = 0;
    }
  }
  ImDrawCmd& last = frame.CmdLists[cover.list]->CmdBuffer[cover.command];
  last.IdxOffset += cover.elements;
  last.ElemCount -= cover.elements;
}

glm::vec3 ColourOf(ImU32 packed) {
  const ImVec4 colour = ImGui::ColorConvertU32ToFloat4(packed);
  return {colour.x, colour.y, colour.z};
}

}  // namespace

bool FramePainter::Paint(ImDrawData& frame, const glm::vec3& background) {
  SetSize(static_cast<int>(std::lround(frame.DisplaySize.x * frame.FramebufferScale.x)),
          static_cast<int>(std::lround(frame.DisplaySize.y * frame.FramebufferScale.y)));
  const std::span<const panels::DamageRect> rects = damage_.Next(frame);
  if (rects.empty()) {
    return false;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, width_, height_);
  commands_.clear();
  ForEachCommand(frame, [&](const ImDrawCmd& command) { commands_.push_back(command); });
  for (const panels::DamageRect& rect : rects) {
    PaintRect(frame, rect, background);
  }
  Restore(frame);
  return true;
}

void FramePainter::Restore(ImDrawData& frame) const {
  auto whole = commands_.begin();
  ForEachCommand(frame, [&](ImDrawCmd& command) { command = *whole++; });
}

void FramePainter::PaintRect(ImDrawData& frame,
                             const panels::DamageRect& rect,
                             const glm::vec3& background) {
  Restore(frame);
  const std::optional<panels::FrameCover> cover =
      panels::FindCover(frame, rect, ImGui::GetIO().Fonts->TexID, ImGui::GetFontTexUvWhitePixel());
  if (cover) {
    SkipHidden(frame, *cover);
  }
  ForEachCommand(frame, [&](ImDrawCmd& command) {
    const ImVec4& clip = command.ClipRect;
    const panels::DamageRect narrow = panels::Intersection({clip.x, clip.y, clip.z, clip.w}, rect);
    command.ClipRect = ImVec4(narrow.from_x, narrow.from_y, narrow.to_x, narrow.to_y);
  });
  const ImVec2& scale = frame.FramebufferScale;
  const glm::vec3 clear = cover ? ColourOf(cover->colour) : background;
  glEnable(GL_SCISSOR_TEST);
  glScissor(static_cast<GLint>(rect.from_x * scale.x),
            height_ - static_cast<GLint>(rect.to_y * scale.y),
            static_cast<GLsizei>((rect.to_x - rect.from_x) * scale.x),
            static_cast<GLsizei>((rect.to_y - rect.from_y) * scale.y));
  glClearColor(clear.r, clear.g, clear.b, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  ImGui_ImplOpenGL3_RenderDrawData(&frame);
}

void FramePainter::CopyInto(uint32_t framebuffer) const {
  glDisable(GL_SCISSOR_TEST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

void FramePainter::SetSize(int width, int height) {
  if (width == width_ && height == height_) {
    return;
  }
  width_ = width;
  height_ = height;
  damage_.Forget();
  colour_ = render::GlTexture::Generate();
  glBindTexture(GL_TEXTURE_2D, colour_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  framebuffer_ = render::GlFramebuffer::Generate();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.id(), 0);
}

}  // namespace lararium::editor
