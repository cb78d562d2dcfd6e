#pragma once

// A menu whose items are chosen by looking at them for a while, or with buttons. It stays in the
// direction in which it was opened while the head turns. There is no item straight ahead, so that
// opening the menu chooses nothing.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "player/kiosk/visitor_actions.h"
#include "shared/geometry/transform.h"

namespace lararium::player {

struct MenuItem {
  std::optional<Action> action;  // nullopt: the item only closes the menu
  std::string text;
  bool repeats = false;  // chosen again and again while the visitor looks at it
  bool closes = false;   // choosing it closes the menu
};

class GazeMenu {
 public:
  // Seconds.
  static constexpr double kDwell = 1.2;   // looking at an item for this time chooses it
  static constexpr double kRepeat = 0.6;  // time until a repeating item is chosen again
  static constexpr double kIdle = 10.0;   // the menu closes after this time without any use

  // The size of a menu with a number of items, on a plane one metre in front of the eye.
  static Eigen::Vector2d SizeOf(size_t items);

  // now: seconds. scale: factor on the size of the menu.
  void Open(std::vector<MenuItem> items, double now, double scale = 1.0);
  void Close() { open_ = false; }
  bool open() const { return open_; }
  // Replaces the texts of the same items.
  void SetItems(std::vector<MenuItem> items) { items_ = std::move(items); }

  // Call this for each frame with the time (seconds) and the camera's pose, whose rotation moves
  // the gaze over the menu; without a pose the gaze stays. Returns the action that was chosen.
  std::optional<Action> Look(double now, const std::optional<geometry::Rigid3>& camera_from_stage);

  // Handles a key or button while the menu is open. taken: the button belongs to the menu ("up",
  // "down", "enter" and those of a controller). action: the action that was chosen.
  struct Pressed {
    bool taken = false;
    std::optional<Action> action;
  };
  Pressed Press(std::string_view button, double now);

  // An item for drawing, with its box on the plane one metre in front of the camera.
  struct Cell {
    Eigen::AlignedBox2d box;
    const std::string* text;
    bool selected;
    float progress;  // 0..1; at 1 the item is chosen
  };
  std::vector<Cell> Cells() const;

 private:
  Eigen::AlignedBox2d BoxOf(size_t item) const;  // relative to the middle of the menu
  void FollowHead(const std::optional<geometry::Rigid3>& camera_from_stage);
  std::optional<size_t> LookedAt() const;
  std::optional<Action> Choose();

  bool open_ = false;
  double scale_ = 1.0;
  std::vector<MenuItem> items_;
  // Viewing direction of the camera when the menu was opened, stage axes.
  std::optional<Eigen::Vector3d> ahead_;
  // Middle of the menu on the camera's plane z = 1; nullopt: behind the visitor.
  std::optional<Eigen::Vector2d> middle_ = Eigen::Vector2d::Zero();
  std::optional<size_t> selected_;
  bool by_gaze_ = false;  // the selected item was selected by gaze and is still looked at
  bool spent_ = false;  // the item was chosen; the gaze must leave it before it can be chosen again
  double looked_since_ = 0.0;
  double wait_ = kDwell;
  double last_sign_ = 0.0;  // time when an item was last looked at or a button was pressed
  double now_ = 0.0;
};

}  // namespace lararium::player
