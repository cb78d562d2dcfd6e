#pragma once

// Which view is open and what the views show; set by the menus, the toolbar and keys.

namespace lararium::panels {

enum class ViewKind { kCamera, kAround, kPicks };

struct ViewOptions {
  ViewKind view = ViewKind::kCamera;
  bool show_stage = true;   // Axes, grid and handles over the camera's picture.
  bool show_points = true;  // Shows the map's points in the scene view.
  // Shows the points that determine the pose over the camera's picture.
  bool show_matches = false;
  // Shows all occluders over the camera's picture, not only the selected one.
  bool show_occluders = false;
  bool show_compare = false;  // Shows a part of the camera's image alone, for comparison.
  bool show_onion = false;    // Shows people at other moments over the camera's picture.
  bool snap = false;          // Handles move in steps in all views without Control.
};

}  // namespace lararium::panels
