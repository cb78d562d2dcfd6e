#pragma once

// The page that is shown while no project is open: recent projects, the sample, what one does with
// the editor, and buttons to open or make projects.

#include <imgui.h>

#include <filesystem>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "editor/jobs/background_task.h"
#include "editor/panels/dialogs/new_project_dialog.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/widgets/keys.h"
#include "editor/session/recent_projects.h"
#include "editor/session/settings.h"

namespace lararium::panels {

// The user's choice on the start page.
struct StartChoice {
  enum class Kind { kNothing, kOpen, kNew, kSample, kStopCopying, kQuit };
  Kind kind = Kind::kNothing;
  std::filesystem::path project;  // The project to open.
  NewProject made;                // The project to make.
};

class StartPage {
 public:
  // Fills the window. keys: those since the last frame. has_sample: the sample exists. copying: the
  // task that copies it; nullptr: none. Removing and locating projects changes recent at once;
  // settings can change too.
  StartChoice Show(editor::RecentProjects& recent,
                   std::span<const KeyPress> keys,
                   bool has_sample,
                   const editor::BackgroundTask* copying,
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
  // The rectangle of a card on the screen, and what the pointer does to it.
  struct Card {
    ImVec2 from;
    ImVec2 size;
    bool hovered = false;
    bool clicked = false;
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
  void DrawCopying(const editor::BackgroundTask& copying, StartChoice& choice);
  void DrawRecent(editor::RecentProjects& recent, bool has_sample, StartChoice& choice);
  // The sample as a card among the projects, and as wide as the page.
  void DrawSampleCard(float width, StartChoice& choice);
  void DrawSample(StartChoice& choice);
  // Film, stage, play: what one does, in three pictures.
  void DrawIntroduction();
  // Begins a card. Its content is drawn over it, and EndCard() moves the cursor behind it.
  static Card BeginCard(const ImVec2& size, bool possible);
  static void EndCard(const Card& card);
  void DrawCard(editor::RecentProjects& recent,
                const editor::RecentProject& project,
                float width,
                StartChoice& choice);
  // key: identifies the picture.
  void DrawPicture(const std::string& key,
                   const std::shared_ptr<const cv::Mat>& picture,
                   const ImVec2& size,
                   bool faded = false);
  // A picture of this page by its name, read at the first call; nullptr: it is not installed.
  const std::shared_ptr<const cv::Mat>& OwnPicture(const std::string& name);
  void DrawDialog(editor::RecentProjects& recent,
                  std::span<const KeyPress> keys,
                  StartChoice& choice);
  void ProjectDialog(editor::RecentProjects& recent, StartChoice& choice);

  std::map<std::filesystem::path, Face> faces_;
  std::map<std::string, std::shared_ptr<const cv::Mat>> own_pictures_;
  double looked_ = -1.0;  // Time of the last look, seconds of ImGui's clock.
  PictureTextures pictures_;
  Open dialog_ = Open::kNothing;
  NewProjectDialog new_;
  std::string folder_;             // The folder of the project to open or to locate.
  std::filesystem::path missing_;  // The project that is being located.
  std::string problem_;
};

}  // namespace lararium::panels
