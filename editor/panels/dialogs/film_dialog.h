#pragma once

// A dialog for filming a place with a camera: the live picture, the next step, and how much of the
// necessary coverage exists.

#include <memory>
#include <string>

#include "editor/jobs/filming.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/viewport/camera_field.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

class FilmDialog {
 public:
  // Shows the dialog while Dialog::kFilm is open. It stays open until the user has decided what to
  // do with the film. state.fields.place: the suggested place. Closing it keeps the film.
  void Show(editor::Workspace& workspace, PictureTextures& pictures, Dialogs& dialogs);

 private:
  void DrawStart(editor::Workspace& workspace, Dialogs& dialogs);
  void Begin(editor::Workspace& workspace, const TitledName& place);
  void DrawFilming(editor::Workspace& workspace, PictureTextures& pictures, Dialogs& dialogs);
  void DrawButtons();
  void DrawQuestion(Dialogs& dialogs);
  void DrawEnded(const editor::Filmed& filmed, Dialogs& dialogs);
  void DrawFailed(const std::string& problem, Dialogs& dialogs);
  void Train(editor::Workspace& workspace, Dialogs& dialogs);
  // Handles Escape and the close button.
  void Leave(editor::Workspace& workspace, Dialogs& dialogs);
  void Discard(Dialogs& dialogs);
  // Keeps the film.
  void Close(Dialogs& dialogs);

  CameraField field_;
  std::string camera_ = "0";
  std::string problem_;  // Why the camera could not be opened.
  TitledName place_;     // The place that is filmed.
  bool asks_ = false;    // Asks what to do with the film.
  std::unique_ptr<editor::FilmTask> film_;
};

}  // namespace lararium::panels
