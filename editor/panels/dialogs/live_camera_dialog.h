#pragma once

// The choice of the live camera for the camera view.

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/viewport/camera_field.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

class LiveCameraDialog {
 public:
  // Shows the dialog while Dialog::kLiveCamera is open. state.fields.camera: the suggested camera.
  void Show(editor::Workspace& workspace, ViewOptions& options, Dialogs& dialogs);

 private:
  void DrawContent(editor::Workspace& workspace, ViewOptions& options, Dialogs& dialogs);

  CameraField field_;
};

}  // namespace lararium::panels
