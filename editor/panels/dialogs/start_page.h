#pragma once

// The page that is shown while no project is open: recent projects, and buttons to open or make
// others.

#include <filesystem>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "editor/panels/dialogs/new_project_dialog.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/widgets/keys.h"
#include "editor/session/recent_projects.h"
#include "editor/session/settings.h"

namespace lararium::panels {

// The user's choice on the start page.
struct StartChoice {
  enum class Kind { kNothing, kOpen, kNew, kSample, kQuit };
  Kind kind = Kind::kNothing;
  std::filesystem::path project;  // The project to open.
  NewProject made;                // The project to make.
};

class StartPage {
 public:
  // Fills the window. keys: those since the last frame. has_sample: the sample exists. Removing and
  // locating projects changes recent at once; settings can change too.
  StartChoice Show(editor::RecentProjects& recent,
                   std::span<const KeyPress> keys,
                   bool has_sample,
                   editor::Settings& settings);

  // Opens the dialog for a new project; recording: see NewProjectDialog::Open().
  void BeginNew(NewProjectDialog::From from,
                const editor::RecentProjects& recent,
                const std::filesystem::path& recording = {});
  // Whether a dialog is open.
  bool has_dialog() const { return dialog_ != Open::kNothing || new_.is_open(); }

  // Shows a problem until the next choice, for example why a project cannot be opened.
  void SetProblem(std::string problem) { problem_ = std::move(problem); }

 private:
  enum class Open { kNothing, kProject, kLocate, kKeys };
  static const char* TitleOf(Open dialog);
  // The state of an entry's folder. It is read at intervals, because folders appear and disappear.
  struct Face {
    bool exists = false;
    std::shared_ptr<const cv::Mat> picture;
  };

  void Look(const editor::RecentProjects& recent);
  void HandleKeys(const editor::RecentProjects& recent,
                  std::span<const KeyPress> keys,
                  StartChoice& choice);
  void OpenDialog(Open dialog, const editor::RecentProjects& recent);
  void DrawActions(const editor::RecentProjects& recent,
                   bool has_sample,
                   editor::Settings& settings,
                   StartChoice& choice);
  void DrawRecent(editor::RecentProjects& recent, StartChoice& choice);
  void DrawCard(editor::RecentProjects& recent,
                const editor::RecentProject& project,
                float width,
                StartChoice& choice);
  void DrawPicture(const editor::RecentProject& project, const Face& face, const ImVec2& size);
  void DrawDialog(editor::RecentProjects& recent,
                  std::span<const KeyPress> keys,
                  StartChoice& choice);
  void ProjectDialog(editor::RecentProjects& recent, StartChoice& choice);

  std::map<std::filesystem::path, Face> faces_;
  double looked_ = -1.0;  // Time of the last look, seconds of ImGui's clock.
  PictureTextures pictures_;
  Open dialog_ = Open::kNothing;
  NewProjectDialog new_;
  std::string folder_;             // The folder of the project to open or to locate.
  std::filesystem::path missing_;  // The project that is being located.
  std::string problem_;
};

}  // namespace lararium::panels
