#include "editor/panels/dialogs/live_camera_dialog.h"

#include "editor/jobs/filming.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

void LiveCameraDialog::DrawContent(editor::Workspace& workspace, EditorState& state) {
  Hint(
      Tr("Through the camera then shows what the camera sees now, with people in it. It must be "
         "of the lens and proportions that the place was trained with. Nothing of it is saved."));
  std::string& camera = state.fields.camera;
  if (BeginProperties("live")) {
    field_.Show(camera, workspace.project().paths().folder);
    EndProperties();
  }
  field_.DrawHint();
  std::string problem;
  std::error_code ignored;
  if (!editor::IsCameraNumber(camera) &&
      !std::filesystem::is_regular_file(workspace.project().paths().Resolve(camera), ignored)) {
    problem = Tr("Choose a file that exists.");
  }
  const DialogAnswer answer = DialogButtons(Tr("Show"), problem);
  if (answer == DialogAnswer::kAct) {
    workspace.preview().PreviewLiveCamera(camera);
    state.view = ViewKind::kCamera;
  }
  if (answer != DialogAnswer::kNone) {
    state.left.erase(Dialog::kLiveCamera);
    state.dialog = Dialog::kNone;
  }
}

void LiveCameraDialog::Show(editor::Workspace& workspace, EditorState& state) {
  if (state.dialog != Dialog::kLiveCamera) {
    return;
  }
  bool open = true;
  const DialogFields typed = state.fields;  // Copied before Escape restores the text of a field.
  DrawModal(Label(Tr("Live camera"), "live").c_str(), 520.0f, open, [&] {
    DrawContent(workspace, state);
    open = state.dialog == Dialog::kLiveCamera;
  });
  if (!open && state.dialog == Dialog::kLiveCamera) {
    state.left[Dialog::kLiveCamera] = typed;
    state.dialog = Dialog::kNone;
  }
}

}  // namespace lararium::panels
