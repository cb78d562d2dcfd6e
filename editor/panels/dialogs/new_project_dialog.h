#pragma once

// The dialog for a new project: where it is made, and what its first place is trained from.

#include <filesystem>
#include <optional>
#include <string>

#include "editor/panels/dialogs/calibration_dialog.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/viewport/picture_textures.h"

namespace lararium::panels {

// A project to make.
struct NewProject {
  // How the project begins: with a recording that its first place is trained from, with filming
  // that recording, or empty.
  enum class Begin { kRecording, kFilming, kEmpty };
  std::filesystem::path folder;  // The project's own folder.
  std::string title;
  Begin begin = Begin::kRecording;
  DialogFields fields;  // The first place and its recording.
};

class NewProjectDialog {
 public:
  enum class From { kVideo, kImages, kCamera, kNothing };

  // parent: the folder that is proposed for the project. recording: the file or folder to begin
  // with, if it is known.
  void Open(From from,
            const std::filesystem::path& parent,
            const std::filesystem::path& recording = {});
  bool is_open() const { return open_; }
  // Draws the dialog while it is open. Returns the project when the user confirms.
  std::optional<NewProject> Show(PictureTextures& pictures);

 private:
  const char* Title() const;
  DialogProblem Problem(const std::filesystem::path& parent, const TitledName& project) const;
  std::optional<NewProject> DrawContent();

  bool open_ = false;
  From from_ = From::kVideo;
  std::string parent_;  // The typed path; a relative one starts at the user's home.
  DialogFields fields_;
  CalibrationDialog calibration_;
};

}  // namespace lararium::panels
