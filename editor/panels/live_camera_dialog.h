#pragma once

// Which live camera the camera view shows, in place of a recording.

#include "editor/app/workspace.h"
#include "editor/panels/camera_field.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

class LiveCameraDialog {
 public:
  // While Dialog::kLiveCamera is open. state.fields.camera: the one that is proposed.
  void Show(app::Workspace& workspace, EditorState& state);

 private:
  void ShowContent(app::Workspace& workspace, EditorState& state);

  CameraField field_;
};

}  // namespace lararium::panels
