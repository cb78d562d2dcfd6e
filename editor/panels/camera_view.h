#pragma once

// Through the camera: the recording, tracked and composited, with the stage and
// the handles of the selected thing over it, and occluders as ghosts.

#include <imgui.h>

#include "editor/app/workspace.h"
#include "editor/panels/corner_view.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/ghost_view.h"
#include "editor/panels/light_view.h"
#include "editor/panels/walk_view.h"
#include "editor/panels/wipe_view.h"
#include "shared/render/texture.h"

namespace lararium::panels {

class CameraView {
 public:
  // Fills the current window.
  void Show(app::Workspace& workspace, EditorState& state);

 private:
  // Of the occluder that is drawn, if one is. origin, size: of the picture on the screen.
  void ShowCorners(app::Workspace& workspace,
                   const EditorState& state,
                   const app::PreviewPicture& picture,
                   const ImVec2& origin,
                   const ImVec2& size,
                   bool hovered,
                   ImDrawList& draw);

  render::Texture texture_;
  GhostView ghosts_;
  WalkView walks_;
  WipeView wipe_;
  CornerDrag corners_;
  LightOverlay light_;
  const app::PreviewPicture* uploaded_ = nullptr;
};

}  // namespace lararium::panels
