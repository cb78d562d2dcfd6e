#pragma once

// What the editor's window shows: the start page, or one project.

#include <memory>
#include <string>
#include <vector>

#include "editor/app/layout.h"
#include "editor/app/recent_projects.h"
#include "editor/app/settings.h"
#include "editor/app/window_sizes.h"
#include "editor/app/workspace.h"
#include "editor/panels/start_page.h"

namespace lararium::app {

// What was chosen when the window was last open; its language is that of all texts from now on.
Settings RestoreSettings(Log& log);
// How large it was then, and keeping that for the next time.
WindowSizes RestoreWindowSizes(Log& log);
void KeepWindowSizes(const WindowSizes& sizes, Log& log);

class WindowContent {
 public:
  // workspace: what is open at first; nullptr: the start page. Borrows log.
  WindowContent(std::unique_ptr<Workspace> workspace,
                const Settings& settings,
                const PanelSizes& panels,
                Log& log);
  ~WindowContent();
  WindowContent(const WindowContent&) = delete;
  WindowContent& operator=(const WindowContent&) = delete;

  std::string Title() const;
  // Something moves without input: redraw soon.
  bool Busy() const { return workspace_ != nullptr && workspace_->Busy(); }
  void AddKey(const panels::KeyPress& press) { keys_.push_back(press); }
  // That the key which was added last types.
  void AddCharacter(char32_t character);
  // What was chosen in the interface; kept at once.
  const Settings& settings() const { return settings_; }
  // As they were dragged.
  const PanelSizes& panels() const { return panels_; }
  // Whether arrows, Enter and Space walk through what is shown, instead of doing what they do
  // there.
  bool keys_walk() const { return layout_ == nullptr || layout_->keys_walk(); }
  // The window was asked to close: what takes long is asked about first.
  void RequestQuit();
  // Somebody asked for the end, and may have it.
  bool quit_requested() const { return quit_; }

  // seconds: since the last call.
  void Update(double seconds);
  // The whole interface, for one frame. Needs the window's OpenGL context.
  Status Show();

 private:
  Status ShowProject();
  void Enter(std::unique_ptr<Workspace> workspace);
  // Back to the start page. Edits that were not saved stay in the project's journal, as they do
  // when the program ends, and are there when it is opened again.
  void Leave();
  void Open(const std::filesystem::path& project);
  Status MakeNew(const panels::StartChoice& choice);
  void Follow(const panels::StartChoice& choice);
  void KeepPicture();

  Log& log_;
  Settings settings_;
  PanelSizes panels_;
  RecentProjects recent_;
  std::filesystem::path sample_;  // as it was shipped; empty: not there
  panels::StartPage start_;
  std::vector<panels::KeyPress> keys_;
  std::unique_ptr<Workspace> workspace_;  // nullptr: the start page is shown
  std::unique_ptr<Layout> layout_;        // of workspace_
  bool pictured_ = false;                 // its picture was kept once
  std::string film_;                      // a place to film, likewise
  bool tour_ = false;                     // begins with the project's first frame
  bool quit_ = false;
};

}  // namespace lararium::app
