#pragma once

// Where the panels are: a fixed arrangement with splitters between them.

#include <memory>

#include "editor/app/workspace.h"
#include "editor/panels/around_view.h"
#include "editor/panels/camera_view.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/pick_view.h"

namespace lararium::app {

class Layout {
 public:
  // Needs the window's OpenGL context.
  static Result<std::unique_ptr<Layout>> Create();

  // The whole interface, for one frame.
  void Show(Workspace& workspace);

  void AddKey(const panels::KeyPress& press) { state_.keys.push_back(press); }
  bool quit_requested() const { return state_.quit; }

 private:
  explicit Layout(std::unique_ptr<panels::AroundView> around) : around_(std::move(around)) {}

  void ShowPanels(Workspace& workspace);
  void ShowViewport(Workspace& workspace);

  panels::EditorState state_;
  panels::CameraView camera_;
  panels::PickView picks_;
  std::unique_ptr<panels::AroundView> around_;
  // Logical pixels.
  float outliner_width_ = 224.0f;
  float inspector_width_ = 336.0f;
  float messages_height_ = 104.0f;
};

}  // namespace lararium::app
