#pragma once

// Calibrating a camera with a chessboard, for the dialog that it was opened from: what shows the
// board, the picture while it is looked for, and what came of it.

#include <memory>
#include <string>

#include "editor/app/calibrating.h"
#include "editor/app/project.h"
#include "editor/panels/camera_field.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/picture_textures.h"

namespace lararium::panels {

class CalibrationDialog {
 public:
  void Open() { open_ = true; }
  bool is_open() const { return open_; }
  // One frame of it, in place of the dialog that it was opened from. fields: of that one, which
  // get the intrinsics where they are to be used, for the size of its recording.
  void Show(const app::ProjectPaths& paths, PictureTextures& pictures, DialogFields& fields);

 private:
  enum class Source { kVideo, kImages, kCamera };

  enum class Page { kStart, kSearch, kResult };

  Page page() const;
  // Ends what is under way.
  void Clear();
  void ShowStart(const app::ProjectPaths& paths);
  void ShowSource(const app::ProjectPaths& paths);
  void WriteBoard(const app::ProjectPaths& paths);
  void Begin(const app::ProjectPaths& paths);
  void ShowSearch(PictureTextures& pictures);
  void ShowResult(const app::ProjectPaths& paths, DialogFields& fields);
  void Use(const app::ProjectPaths& paths, DialogFields& fields);

  bool open_ = false;
  int source_ = 0;  // a Source
  std::string files_[3] = {"", "", "0"};
  CameraField camera_;
  train::Board board_;
  std::string problem_;  // why there is no result, or it cannot be used
  std::string written_;  // the board to print
  std::unique_ptr<app::CalibrationTask> task_;
};

}  // namespace lararium::panels
