#pragma once

// A comparison of before and after: left of a line that can be dragged, the camera's image alone
// covers the picture.

#include <imgui.h>

#include "editor/session/workspace.h"
#include "shared/render/gl/texture.h"

namespace lararium::panels {

class CompareSlider {
 public:
  // shown: the comparison is on. origin, size: the picture on the screen. hovered: the pointer is
  // over the view. Returns true while the line uses the pointer. Does nothing while the picture has
  // no image to compare with.
  bool Show(bool shown,
            const editor::PreviewPicture& picture,
            const ImVec2& origin,
            const ImVec2& size,
            bool hovered,
            ImDrawList& draw);

 private:
  render::Texture plain_;
  const editor::PreviewPicture* uploaded_ = nullptr;
  float at_ = 0.5f;  // Share of the picture's width.
  bool dragged_ = false;
};

}  // namespace lararium::panels
