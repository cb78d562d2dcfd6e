#pragma once

// Filming a place with a camera, in a dialog: the live picture, what to do next, and how much of
// what visitors need is there already.

#include <memory>
#include <string>

#include "editor/app/filming.h"
#include "editor/app/workspace.h"
#include "editor/panels/camera_field.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

class FilmDialog {
 public:
  // While Dialog::kFilm is open, which it stays while a film is there that nobody decided about.
  // state.fields.place: the place that is proposed. Going away keeps what was filmed.
  void Show(app::Workspace& workspace, EditorState& state);

 private:
  void ShowStart(app::Workspace& workspace, EditorState& state);
  void Begin(app::Workspace& workspace, const std::string& place);
  void ShowFilming(app::Workspace& workspace, EditorState& state);
  void ShowButtons();
  void ShowQuestion(EditorState& state);
  void ShowEnded(const app::Filmed& filmed, EditorState& state);
  void ShowFailed(const std::string& problem, EditorState& state);
  void Train(app::Workspace& workspace, EditorState& state);
  // What Escape and the cross do.
  void Leave(app::Workspace& workspace, EditorState& state);
  void Discard(EditorState& state);
  // Keeps what was filmed.
  void Close(EditorState& state);

  CameraField field_;
  std::string camera_ = "0";
  std::string problem_;  // why the camera could not be opened
  std::string place_;    // that is filmed
  bool asks_ = false;    // what is to become of the film
  std::unique_ptr<app::FilmTask> film_;
};

}  // namespace lararium::panels
