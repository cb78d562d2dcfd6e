#pragma once

// What belongs to the selected light probe over the camera's picture: the balls, picks on the
// stage, the histogram.

#include <imgui.h>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

class LightOverlay {
 public:
  // Whether it needs the camera's image alone besides the picture (Workspace::SetCompare).
  static bool ComparesPictures(const app::Workspace& workspace, const EditorState& state);

  // origin, size: of the picture on the screen. hovered: the pointer is over the view. Nothing
  // where no probe is selected.
  void Show(app::Workspace& workspace,
            EditorState& state,
            const app::PreviewPicture& picture,
            const ImVec2& origin,
            const ImVec2& size,
            bool hovered,
            ImDrawList& draw);

 private:
  bool drags_ball_ = false;
};

}  // namespace lararium::panels
