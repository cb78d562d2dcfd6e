#pragma once

// A menu whose items are chosen by looking at them for a while, or with buttons. It stays where
// it was opened while the head turns; straight ahead of there is nothing, so that nothing is
// chosen by opening it.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "player/visitor_actions.h"
#include "shared/geometry/transform.h"

namespace lararium::player {

struct MenuItem {
  std::optional<Action> action;  // none: only closes the menu
  std::string text;
  bool repeats = false;  // while it is looked at
  bool closes = false;   // the menu
};

class GazeMenu {
 public:
  // Seconds.
  static constexpr double kDwell = 1.2;   // of looking at an item until it is chosen
  static constexpr double kRepeat = 0.6;  // and chosen again
  static constexpr double kIdle = 10.0;   // without looking at any, until the menu goes

  // Of a menu of so many items, on a plane one metre before the eye.
  static Eigen::Vector2d SizeOf(size_t items);

  // scale: of its size.
  void Open(std::vector<MenuItem> items, double now, double scale = 1.0);
  void Close() { open_ = false; }
  bool open() const { return open_; }
  // Other words for the same items.
  void SetItems(std::vector<MenuItem> items) { items_ = std::move(items); }

  // A frame: the time and the camera's pose, by whose turns the gaze moves over the menu; without
  // one it stays. What was chosen, if anything.
  std::optional<Action> Look(double now, const std::optional<geometry::Rigid3>& camera_from_stage);

  // A key or button while the menu is open: whether it is the menu's ("up", "down", "enter" and
  // those of a controller), and what was chosen.
  struct Pressed {
    bool taken = false;
    std::optional<Action> action;
  };
  Pressed Press(std::string_view button, double now);

  // An item as it is to be drawn: its box on the plane one metre before the camera.
  struct Cell {
    Eigen::AlignedBox2d box;
    const std::string* text;
    bool selected;
    float progress;  // 0..1, until it is chosen
  };
  std::vector<Cell> Cells() const;

 private:
  Eigen::AlignedBox2d BoxOf(size_t item) const;  // about the menu's middle
  void FollowHead(const std::optional<geometry::Rigid3>& camera_from_stage);
  std::optional<size_t> LookedAt() const;
  std::optional<Action> Choose();

  bool open_ = false;
  double scale_ = 1.0;
  std::vector<MenuItem> items_;
  std::optional<Eigen::Vector3d> ahead_;  // of the camera when it was opened, stage axes
  // Of the menu, on the camera's plane z = 1; none: behind the visitor.
  std::optional<Eigen::Vector2d> middle_ = Eigen::Vector2d::Zero();
  std::optional<size_t> selected_;
  bool by_gaze_ = false;  // it was selected by looking at it, and is looked at
  bool spent_ = false;    // it was chosen, and has to be left before it is again
  double looked_since_ = 0.0;
  double wait_ = kDwell;
  double last_sign_ = 0.0;  // when somebody last looked at an item or pressed a button
  double now_ = 0.0;
};

}  // namespace lararium::player
