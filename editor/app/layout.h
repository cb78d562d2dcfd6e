#pragma once

// Where the panels are: a fixed arrangement with splitters between them.

#include <memory>
#include <string>

#include "editor/app/window_sizes.h"
#include "editor/app/workspace.h"
#include "editor/panels/around_view.h"
#include "editor/panels/calibration_dialog.h"
#include "editor/panels/camera_view.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/film_dialog.h"
#include "editor/panels/live_camera_dialog.h"
#include "editor/panels/missing_panel.h"
#include "editor/panels/pick_view.h"
#include "editor/panels/script_panel.h"
#include "editor/panels/timeline_panel.h"
#include "editor/panels/tour.h"

namespace lararium::app {

class Layout {
 public:
  // Needs the window's OpenGL context.
  static Result<std::unique_ptr<Layout>> Create();

  // The whole interface, for one frame. settings and sizes: may be changed in it.
  void Show(Workspace& workspace, Settings& settings, PanelSizes& sizes);

  void BeginTour() { state_.begin_tour = true; }
  // Opens the dialog that films a place.
  void BeginFilming(const std::string& place);
  void AddKey(const panels::KeyPress& press) { state_.keys.push_back(press); }
  // Whether arrows, Enter and Space walk through the panel that has the keyboard.
  bool keys_walk() const { return state_.keyboard.walks(); }
  void RequestQuit() { state_.quit = true; }
  // Asked for, and granted where something takes long.
  bool quit_requested() const { return state_.quit && may_leave_; }
  bool leave_requested() const { return state_.leave && may_leave_; }

 private:
  explicit Layout(std::unique_ptr<panels::AroundView> around) : around_(std::move(around)) {}

  void HandleKeys(Workspace& workspace);
  void AskBeforeLeaving(const Workspace& workspace);
  void TakeResizing();
  void ResizeByKeys(float outliner, float inspector, float bottom, PanelSizes& sizes);
  void ShowPanels(Workspace& workspace, PanelSizes& sizes);
  void ShowViewport(Workspace& workspace);
  void ShowBottom(Workspace& workspace);

  panels::EditorState state_;
  panels::CameraView camera_;
  panels::PickView picks_;
  std::unique_ptr<panels::AroundView> around_;
  panels::TimelinePanel timeline_;
  panels::ScriptPanel script_;
  panels::MissingPanel missing_;
  panels::FilmDialog film_;
  panels::LiveCameraDialog live_camera_;
  panels::CalibrationDialog calibration_;
  panels::Tour tour_;
  bool opened_ = false;  // a frame was shown
  bool menus_ = false;   // had the keyboard at its end
  bool may_leave_ = true;
  bool asked_ = false;  // whether to stop what takes long
  float grow_ = 0.0f;   // logical pixels, by keys, the panel that has the keyboard
};

}  // namespace lararium::app
