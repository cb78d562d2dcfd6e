#include "editor/panels/dialogs/live_camera_dialog.h"

#include "editor/jobs/filming.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

void LiveCameraDialog::DrawContent(editor::Workspace& workspace,
                                   ViewOptions& options,
                                   Dialogs& dialogs) {
  Hint(
      Tr("Through the camera then shows what the camera sees now, with people in it. It must be "
         "of the lens and proportions that the place was trained with. Nothing of it is saved."));
  std::string& camera = dialogs.fields.camera;
  if (BeginProperties("live")) {
    field_.Show(camera, workspace.project().paths().folder);
    EndProperties();
  }
  field_.DrawHint();
  DialogProblem problem;
  std::error_code ignored;
  if (camera.empty()) {
    problem = Missing(Tr("Choose a camera or a video."));
  } else if (!editor::IsCameraNumber(camera) &&
             !std::filesystem::is_regular_file(workspace.project().paths().Resolve(camera),
                                               ignored)) {
    problem = Wrong(Tr("Choose a file that exists."));
  }
  const DialogAnswer answer = DialogButtons(Tr("Show"), problem);
  if (answer == DialogAnswer::kAct) {
    workspace.preview().PreviewLiveCamera(camera);
    options.view = ViewKind::kCamera;
  }
  if (answer != DialogAnswer::kNone) {
    dialogs.left.erase(Dialog::kLiveCamera);
    dialogs.shown = Dialog::kNone;
  }
}

void LiveCameraDialog::Show(editor::Workspace& workspace, ViewOptions& options, Dialogs& dialogs) {
  if (dialogs.shown != Dialog::kLiveCamera) {
    return;
  }
  bool open = true;
  const DialogFields typed = dialogs.fields;  // Copied before Escape restores the text of a field.
  DrawModal(Label(Tr("Live camera"), "live").c_str(), 520.0f, open, [&] {
    DrawContent(workspace, options, dialogs);
    open = dialogs.shown == Dialog::kLiveCamera;
  });
  if (!open && dialogs.shown == Dialog::kLiveCamera) {
    dialogs.left[Dialog::kLiveCamera] = typed;
    dialogs.shown = Dialog::kNone;
  }
}

}  // namespace lararium::panels
