#pragma once

// What the editor's window shows: the start page, or one project.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "editor/panels/dialogs/dropped_file.h"
#include "editor/panels/dialogs/start_page.h"
#include "editor/session/recent_projects.h"
#include "editor/session/settings.h"
#include "editor/session/workspace.h"
#include "editor/window/layout.h"
#include "editor/window/window_sizes.h"

namespace lararium::editor {

// Loads the settings of the last session and activates their language for all texts.
Settings RestoreSettings(Log& log);
// Loads or saves the sizes of the window and its panels.
WindowSizes RestoreWindowSizes(Log& log);
void KeepWindowSizes(const WindowSizes& sizes, Log& log);

class WindowContent {
 public:
  // workspace: the project to show first; nullptr: the start page. Borrows log.
  WindowContent(std::unique_ptr<Workspace> workspace,
                const Settings& settings,
                const PanelSizes& panels,
                Log& log);
  ~WindowContent();
  WindowContent(const WindowContent&) = delete;
  WindowContent& operator=(const WindowContent&) = delete;

  std::string Title() const;
  // Whether something changes without input, so that a redraw is due soon.
  bool Busy() const { return copying_ != nullptr || (workspace_ != nullptr && workspace_->Busy()); }
  void AddKey(const panels::KeyPress& press) { keys_.push_back(press); }
  // Sets the character that the last added key types.
  void AddCharacter(char32_t character);
  // Files and folders that were dropped on the window. A field of an open dialog takes what fits;
  // otherwise a project is opened, a recording begins a project or a place, and so on.
  void Drop(const std::vector<std::filesystem::path>& paths);
  // The settings chosen in the interface; saved at once.
  const Settings& settings() const { return settings_; }
  // The panel sizes set by dragging.
  const PanelSizes& panels() const { return panels_; }
  // Whether arrows, Enter and Space navigate between widgets, instead of having their meaning in
  // the panel.
  bool keys_walk() const { return layout_ == nullptr || layout_->keys_walk(); }
  // The window was asked to close. If a long task runs, the user is asked first.
  void RequestQuit();
  // True after a request to quit that may proceed.
  bool quit_requested() const { return quit_; }

  // seconds: time since the last call.
  void Update(double seconds);
  // Draws the whole interface for one frame. Requires the window's OpenGL context.
  Status Show();

 private:
  Status DrawProject();
  void Enter(std::unique_ptr<Workspace> workspace);
  // Returns to the start page. Unsaved edits stay in the project's journal, as they do when the
  // program ends, and are restored when the project is opened again.
  void Leave();
  void Open(const std::filesystem::path& project);
  Status MakeNew(const panels::NewProject& made);
  void Follow(const panels::StartChoice& choice);
  // Copies the sample in the background, and opens the copy.
  void CopySample();
  void OpenCopiedSample();
  // Starts what the sample does by itself: its first picture plays, unless the user did something
  // before, and the tour begins. Where the place is not trained, training begins with the tour.
  void BeginSample();
  void KeepPicture();
  void TakeDrop();
  void DropOnStart(const panels::DroppedFile& dropped);

  Log& log_;
  Settings settings_;
  PanelSizes panels_;
  RecentProjects recent_;
  std::filesystem::path shipped_;  // Folder of the shipped sample; empty: not installed.
  std::shared_ptr<std::filesystem::path> own_sample_;  // The result of copying_.
  std::unique_ptr<BackgroundTask> copying_;            // nullptr: the sample is not being copied.
  panels::StartPage start_;
  std::vector<panels::KeyPress> keys_;
  std::unique_ptr<Workspace> workspace_;  // nullptr: the start page is shown.
  std::unique_ptr<Layout> layout_;        // The layout of workspace_.
  bool pictured_ = false;                 // True after the project's picture was saved.
  panels::DroppedFile dropped_;
  bool has_dropped_ = false;    // True until dropped_ was taken or told about.
  std::filesystem::path next_;  // The project to open when the present one is left.
  std::string film_;            // Place to film, opened with the project's first frame.
  bool tour_ = false;           // The tour of the sample has to begin.
  bool plays_ = false;          // The sample has to begin playing.
  bool quit_ = false;
};

}  // namespace lararium::editor
