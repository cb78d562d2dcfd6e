#pragma once

// The layout of the panels: a fixed arrangement with splitters between them.

#include <memory>
#include <string>

#include "editor/panels/dialogs/calibration_dialog.h"
#include "editor/panels/dialogs/dropped_file.h"
#include "editor/panels/dialogs/film_dialog.h"
#include "editor/panels/dialogs/live_camera_dialog.h"
#include "editor/panels/dialogs/missing_files_panel.h"
#include "editor/panels/dialogs/tour.h"
#include "editor/panels/timeline/script_panel.h"
#include "editor/panels/timeline/timeline_panel.h"
#include "editor/panels/viewport/camera_view.h"
#include "editor/panels/viewport/pick_view.h"
#include "editor/panels/viewport/portrait_view.h"
#include "editor/panels/viewport/scene_view.h"
#include "editor/session/settings.h"
#include "editor/session/workspace.h"
#include "editor/window/window_sizes.h"

namespace lararium::editor {

class Layout {
 public:
  // Requires the window's OpenGL context.
  static Result<std::unique_ptr<Layout>> Create();

  // Draws the whole interface for one frame. It may change settings and sizes.
  void Show(Workspace& workspace, Settings& settings, PanelSizes& sizes);

  void BeginTour() { actions_.emplace_back(panels::StartTour()); }
  // Opens the dialog that films a place.
  void BeginFilming(const std::string& place);
  void AddKey(const panels::KeyPress& press) { input_.keys.push_back(press); }
  // Whether arrows, Enter and Space navigate in the panel with keyboard focus.
  bool keys_walk() const { return input_.keyboard.walks(); }
  // Begins what a dropped file is for: a dialog with the file filled in, or a message.
  void Drop(Workspace& workspace, const panels::DroppedFile& dropped);
  void TellOfDrop(const std::string& text);
  // Whether a dialog is open.
  bool has_dialog() const {
    return dialogs_.shown != panels::Dialog::kNone || calibration_.is_open() || missing_.locating();
  }
  void RequestLeave() { actions_.emplace_back(panels::CloseProject()); }
  // Whether the project was asked to close, and the user has not chosen to stay.
  bool leaving() const { return leave_; }
  void RequestQuit() { actions_.emplace_back(panels::CloseWindow()); }
  // True after a request to quit, or to return to the start page, if no long task runs or the user
  // has chosen to stop it.
  bool quit_requested() const { return quit_ && may_leave_; }
  bool leave_requested() const { return leave_ && may_leave_; }

 private:
  explicit Layout(std::unique_ptr<panels::SceneView> around) : around_(std::move(around)) {}

  panels::PanelContext Context(Workspace& workspace) {
    return {workspace, selection_, options_, tools_, cast_, pictures_, input_, dialogs_, actions_};
  }
  void HandleKeys(Workspace& workspace);
  // Carries out what the panels have requested since the last call.
  void DrainActions(const Workspace& workspace);
  void AskBeforeLeaving(const Workspace& workspace);
  void TakeResizing();
  void ResizeByKeys(float outliner, float inspector, float bottom, PanelSizes& sizes);
  void DrawPanels(Workspace& workspace, PanelSizes& sizes);
  void DrawViewport(Workspace& workspace);
  void DrawBottom(Workspace& workspace);

  // Shared by several panels.
  panels::Selection selection_;
  panels::ViewOptions options_;
  panels::ViewTools tools_;
  panels::CastView cast_;
  panels::PictureTextures pictures_;
  panels::Input input_;
  panels::Dialogs dialogs_;
  panels::EditorActions actions_;

  panels::CameraView camera_;
  panels::PickView picks_;
  std::unique_ptr<panels::SceneView> around_;
  panels::TimelinePanel timeline_;
  panels::ScriptPanel script_;
  panels::MissingFilesPanel missing_;
  panels::FilmDialog film_;
  panels::LiveCameraDialog live_camera_;
  panels::CalibrationDialog calibration_;
  panels::Tour tour_;
  panels::BottomTab bottom_ = panels::BottomTab::kTimeline;
  uint64_t messages_read_ = 0;  // See MessageLog::told().
  bool opened_ = false;         // True after the first frame.
  bool menus_ = false;          // True if menus had the keyboard at the end of the last frame.
  bool quit_ = false;           // The window was asked to close.
  bool leave_ = false;          // The project was asked to close.
  bool stops_work_ = false;     // Leaving may stop long work.
  bool may_leave_ = true;
  bool asked_ = false;  // True after the user was asked to stop a long task.
  float grow_ = 0.0f;   // Growth by keys of the focused panel, logical pixels.
};

}  // namespace lararium::editor
