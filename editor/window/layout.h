#pragma once

// The layout of the panels: a fixed arrangement with splitters between them.

#include <memory>
#include <string>

#include "editor/panels/dialogs/calibration_dialog.h"
#include "editor/panels/dialogs/film_dialog.h"
#include "editor/panels/dialogs/live_camera_dialog.h"
#include "editor/panels/dialogs/missing_files_panel.h"
#include "editor/panels/dialogs/tour.h"
#include "editor/panels/timeline/script_panel.h"
#include "editor/panels/timeline/timeline_panel.h"
#include "editor/panels/viewport/camera_view.h"
#include "editor/panels/viewport/pick_view.h"
#include "editor/panels/viewport/scene_view.h"
#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"
#include "editor/window/window_sizes.h"

namespace lararium::editor {

class Layout {
 public:
  // Requires the window's OpenGL context.
  static Result<std::unique_ptr<Layout>> Create();

  // Draws the whole interface for one frame. It may change settings and sizes.
  void Show(Workspace& workspace, Settings& settings, PanelSizes& sizes);

  void BeginTour() { state_.begin_tour = true; }
  // Opens the dialog that films a place.
  void BeginFilming(const std::string& place);
  void AddKey(const panels::KeyPress& press) { state_.keys.push_back(press); }
  // Whether arrows, Enter and Space navigate in the panel with keyboard focus.
  bool keys_walk() const { return state_.keyboard.walks(); }
  void RequestQuit() { state_.quit = true; }
  // True after a request to quit, or to return to the start page, if no long task runs or the user
  // has chosen to stop it.
  bool quit_requested() const { return state_.quit && may_leave_; }
  bool leave_requested() const { return state_.leave && may_leave_; }

 private:
  explicit Layout(std::unique_ptr<panels::SceneView> around) : around_(std::move(around)) {}

  void HandleKeys(Workspace& workspace);
  void AskBeforeLeaving(const Workspace& workspace);
  void TakeResizing();
  void ResizeByKeys(float outliner, float inspector, float bottom, PanelSizes& sizes);
  void DrawPanels(Workspace& workspace, PanelSizes& sizes);
  void DrawViewport(Workspace& workspace);
  void DrawBottom(Workspace& workspace);

  panels::EditorState state_;
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
  bool opened_ = false;  // True after the first frame.
  bool menus_ = false;   // True if menus had the keyboard at the end of the last frame.
  bool may_leave_ = true;
  bool asked_ = false;  // True after the user was asked to stop a long task.
  float grow_ = 0.0f;   // Growth by keys of the focused panel, logical pixels.
};

}  // namespace lararium::editor
