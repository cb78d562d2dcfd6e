#pragma once

// Through the camera: the recording, tracked and composited, with the stage and
// the handles of the selected thing over it, and occluders as ghosts.

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/ghost_view.h"
#include "editor/panels/light_view.h"
#include "editor/panels/wipe_view.h"
#include "shared/render/texture.h"

namespace lararium::panels {

class CameraView {
 public:
  // Fills the current window.
  void Show(app::Workspace& workspace, EditorState& state);

 private:
  render::Texture texture_;
  GhostView ghosts_;
  WipeView wipe_;
  LightOverlay light_;
  const app::PreviewPicture* uploaded_ = nullptr;
};

}  // namespace lararium::panels
