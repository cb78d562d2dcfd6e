#pragma once

// A dialog for filming a place with a camera: the live picture, the next step, and how much of the
// necessary coverage exists.

#include <memory>
#include <string>

#include "editor/jobs/filming.h"
#include "editor/panels/viewport/camera_field.h"
#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

class FilmDialog {
 public:
  // Shows the dialog while Dialog::kFilm is open. It stays open until the user has decided what to
  // do with the film. state.fields.place: the suggested place. Closing it keeps the film.
  void Show(editor::Workspace& workspace, EditorState& state);

 private:
  void DrawStart(editor::Workspace& workspace, EditorState& state);
  void Begin(editor::Workspace& workspace, const std::string& place);
  void DrawFilming(editor::Workspace& workspace, EditorState& state);
  void DrawButtons();
  void DrawQuestion(EditorState& state);
  void DrawEnded(const editor::Filmed& filmed, EditorState& state);
  void DrawFailed(const std::string& problem, EditorState& state);
  void Train(editor::Workspace& workspace, EditorState& state);
  // Handles Escape and the close button.
  void Leave(editor::Workspace& workspace, EditorState& state);
  void Discard(EditorState& state);
  // Keeps the film.
  void Close(EditorState& state);

  CameraField field_;
  std::string camera_ = "0";
  std::string problem_;  // Why the camera could not be opened.
  std::string place_;    // The place that is filmed.
  bool asks_ = false;    // Asks what to do with the film.
  std::unique_ptr<editor::FilmTask> film_;
};

}  // namespace lararium::panels
