#pragma once

// Filming a place with a camera, in a dialog: the live picture, what to do next, and how much of
// what visitors need is there already.

#include <memory>
#include <string>

#include "editor/app/filming.h"
#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

class FilmDialog {
 public:
  // While Dialog::kFilm is open. state.fields.place: the place that is proposed.
  void Show(app::Workspace& workspace, EditorState& state);

 private:
  void ShowStart(app::Workspace& workspace, EditorState& state);
  void ShowFilming(app::Workspace& workspace, EditorState& state);
  void Close(EditorState& state);

  std::string camera_ = "0";
  std::string problem_;  // why the camera could not be opened
  std::unique_ptr<app::FilmTask> film_;
};

}  // namespace lararium::panels
