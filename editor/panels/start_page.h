#pragma once

// What the window shows while no project is open: those that were opened before, and ways
// to others.

#include <filesystem>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "editor/app/recent_projects.h"
#include "editor/panels/calibration_dialog.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/picture_textures.h"

namespace lararium::panels {

// What somebody chose on the start page.
struct StartChoice {
  enum class Kind { kNothing, kOpen, kNew, kSample, kQuit };
  // What a new project begins with: a recording to train its first place from, filming that
  // recording, or nothing.
  enum class Begin { kRecording, kFilming, kEmpty };
  Kind kind = Kind::kNothing;
  std::filesystem::path project;  // to open, or to make
  Begin begin = Begin::kRecording;
  DialogFields fields;  // of a new project: its name, its place and recording
};

class StartPage {
 public:
  // Fills the window. keys: since the last frame. has_sample: whether the sample is there.
  // Forgetting and locating projects changes recent at once.
  // settings may be changed too.
  StartChoice Show(app::RecentProjects& recent,
                   std::span<const KeyPress> keys,
                   bool has_sample,
                   app::Settings& settings);

  // Shown until the next choice, such as why a project cannot be opened.
  void SetProblem(std::string problem) { problem_ = std::move(problem); }

 private:
  enum class Open { kNothing, kVideo, kImages, kCamera, kEmpty, kProject, kLocate, kKeys };
  static const char* TitleOf(Open dialog);
  // What is known of an entry's folder; looked at now and then, as folders come and go.
  struct Face {
    bool exists = false;
    std::shared_ptr<const cv::Mat> picture;
  };

  void Look(const app::RecentProjects& recent);
  void HandleKeys(const app::RecentProjects& recent,
                  std::span<const KeyPress> keys,
                  StartChoice& choice);
  void OpenDialog(Open dialog, const app::RecentProjects& recent);
  void ShowActions(const app::RecentProjects& recent,
                   bool has_sample,
                   app::Settings& settings,
                   StartChoice& choice);
  void ShowRecent(app::RecentProjects& recent, StartChoice& choice);
  void ShowCard(app::RecentProjects& recent,
                const app::RecentProject& project,
                float width,
                StartChoice& choice);
  void ShowPicture(const app::RecentProject& project, const Face& face, const ImVec2& size);
  void ShowDialog(app::RecentProjects& recent, std::span<const KeyPress> keys, StartChoice& choice);
  void NewDialog(StartChoice& choice);
  std::string NewProblem(const std::filesystem::path& parent) const;
  void ProjectDialog(app::RecentProjects& recent, StartChoice& choice);

  std::map<std::filesystem::path, Face> faces_;
  double looked_ = -1.0;  // seconds, ImGui's clock
  PictureTextures pictures_;
  Open dialog_ = Open::kNothing;
  DialogFields fields_;
  CalibrationDialog calibration_;
  std::string folder_;             // that a new project goes into, or a project is looked for in
  std::filesystem::path missing_;  // that is being located
  std::string problem_;
};

}  // namespace lararium::panels
