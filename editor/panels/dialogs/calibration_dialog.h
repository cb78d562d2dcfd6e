#pragma once

// Calibration of a camera with a chessboard, opened from a dialog about a recording. It explains
// the board, shows the images during the search, and shows the result.

#include <memory>
#include <string>

#include "editor/document/project.h"
#include "editor/jobs/calibrating.h"
#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/viewport/camera_field.h"
#include "editor/panels/viewport/picture_textures.h"

namespace lararium::panels {

class CalibrationDialog {
 public:
  void Open() { open_ = true; }
  bool is_open() const { return open_; }
  // Shows one frame, in place of the dialog from which it was opened. fields: those of that dialog;
  // they receive the intrinsics for the size of its recording if the user accepts them.
  void Show(const editor::ProjectPaths& paths, PictureTextures& pictures, DialogFields& fields);

 private:
  enum class Source { kVideo, kImages, kCamera };

  enum class Page { kStart, kSearch, kResult };

  Page page() const;
  // Ends the running calibration.
  void Clear();
  void DrawStart(const editor::ProjectPaths& paths);
  void DrawSource(const editor::ProjectPaths& paths);
  void WriteBoard(const editor::ProjectPaths& paths);
  void Begin(const editor::ProjectPaths& paths);
  void DrawSearch(PictureTextures& pictures);
  void DrawResult(const editor::ProjectPaths& paths, DialogFields& fields);
  void Use(const editor::ProjectPaths& paths, DialogFields& fields);

  bool open_ = false;
  int source_ = 0;  // A Source.
  std::string files_[3] = {"", "", "0"};
  CameraField camera_;
  train::Board board_;
  std::string problem_;  // Why there is no result, or why it cannot be used.
  std::string written_;  // The file of the board that was written for printing.
  std::unique_ptr<editor::CalibrationTask> task_;
};

}  // namespace lararium::panels
