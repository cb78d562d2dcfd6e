#pragma once

// Before and after: the camera's image alone over the picture, to the left of a line that is
// dragged.

#include <imgui.h>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "shared/render/texture.h"

namespace lararium::panels {

class WipeView {
 public:
  // origin, size: of the picture on the screen. hovered: the pointer is over the view. True while
  // the line wants the pointer for itself. Nothing before the picture has come with the image.
  bool Show(EditorState& state,
            const app::PreviewPicture& picture,
            const ImVec2& origin,
            const ImVec2& size,
            bool hovered,
            ImDrawList& draw);

 private:
  render::Texture plain_;
  const app::PreviewPicture* uploaded_ = nullptr;
  bool dragged_ = false;
};

}  // namespace lararium::panels
