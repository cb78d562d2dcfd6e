#include "player/app/gaze_menu.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace lararium::player {
namespace {

// Sizes on a plane one metre in front of the eye: two columns with a gap between them.
constexpr double kCellWidth = 0.28;
constexpr double kCellHeight = 0.085;
constexpr double kRowStep = 0.1;
constexpr double kHalfWay = 0.07;
constexpr double kBehind = 0.1;  // below this depth the menu counts as behind the visitor

bool IsOneOf(std::string_view button, std::initializer_list<std::string_view> buttons) {
  return std::ranges::find(buttons, button) != buttons.end();
}

}  // namespace

Eigen::Vector2d GazeMenu::SizeOf(size_t items) {
  const auto rows = static_cast<double>((items + 1) / 2);
  return {2.0 * (kHalfWay + kCellWidth), (rows - 1.0) * kRowStep + kCellHeight};
}

void GazeMenu::Open(std::vector<MenuItem> items, double now, double scale) {
  *this = GazeMenu();
  open_ = true;
  scale_ = scale;
  items_ = std::move(items);
  last_sign_ = now_ = now;
}

Eigen::AlignedBox2d GazeMenu::BoxOf(size_t item) const {
  const size_t rows = (items_.size() + 1) / 2;
  const double side = item % 2 == 0 ? -1.0 : 1.0;
  const double row = static_cast<double>(item / 2) - 0.5 * static_cast<double>(rows - 1);
  const Eigen::Vector2d middle(side * (kHalfWay + 0.5 * kCellWidth), row * kRowStep);
  const Eigen::Vector2d half(0.5 * kCellWidth, 0.5 * kCellHeight);
  return {scale_ * (middle - half), scale_ * (middle + half)};
}

void GazeMenu::FollowHead(const std::optional<geometry::Rigid3>& camera_from_stage) {
  if (!camera_from_stage) {
    return;
  }
  if (!ahead_) {
    ahead_ = camera_from_stage->rotation.conjugate() * Eigen::Vector3d::UnitZ();
  }
  const Eigen::Vector3d in_camera = camera_from_stage->rotation * *ahead_;
  middle_.reset();
  if (in_camera.z() > kBehind) {
    middle_ = in_camera.hnormalized();
  }
}

std::optional<size_t> GazeMenu::LookedAt() const {
  for (size_t i = 0; middle_ && i < items_.size(); ++i) {
    if (BoxOf(i).contains(Eigen::Vector2d(-*middle_))) {
      return i;
    }
  }
  return std::nullopt;
}

std::optional<Action> GazeMenu::Choose() {
  const MenuItem& item = items_[*selected_];
  open_ = !item.closes;
  spent_ = !item.repeats;
  wait_ = kRepeat;
  looked_since_ = now_;
  return item.action;
}

std::optional<Action> GazeMenu::Look(double now,
                                     const std::optional<geometry::Rigid3>& camera_from_stage) {
  if (!open_) {
    return std::nullopt;
  }
  now_ = now;
  FollowHead(camera_from_stage);
  const std::optional<size_t> looked_at = LookedAt();
  if (looked_at) {
    last_sign_ = now;
  }
  if (now - last_sign_ >= kIdle) {
    Close();
    return std::nullopt;
  }
  if (!looked_at) {
    if (by_gaze_) {
      selected_.reset();
    }
    by_gaze_ = false;
    return std::nullopt;
  }
  if (!by_gaze_ || selected_ != looked_at) {
    selected_ = looked_at;
    by_gaze_ = true;
    spent_ = false;
    wait_ = kDwell;
    looked_since_ = now;
  }
  return !spent_ && now - looked_since_ >= wait_ ? Choose() : std::nullopt;
}

GazeMenu::Pressed GazeMenu::Press(std::string_view button, double now) {
  const bool up = IsOneOf(button, {"up", "pad_up"});
  const bool down = IsOneOf(button, {"down", "pad_down"});
  const bool choose = IsOneOf(button, {"enter", "pad_a", kHandSelect});
  if (!open_ || items_.empty() || !(up || down || choose)) {
    return {};
  }
  last_sign_ = now_ = now;
  if (choose) {
    return {true, selected_ ? Choose() : std::nullopt};
  }
  const size_t count = items_.size();
  selected_ = !selected_ ? (down ? 0 : count - 1) : (*selected_ + (down ? 1 : count - 1)) % count;
  by_gaze_ = false;
  spent_ = false;
  return {true, std::nullopt};
}

std::vector<GazeMenu::Cell> GazeMenu::Cells() const {
  std::vector<Cell> cells;
  for (size_t i = 0; open_ && middle_ && i < items_.size(); ++i) {
    Eigen::AlignedBox2d box = BoxOf(i);
    box.translate(*middle_);
    const bool selected = selected_ == i;
    const double progress = selected && by_gaze_ && !spent_ ? (now_ - looked_since_) / wait_ : 0.0;
    cells.push_back(
        {box, &items_[i].text, selected, static_cast<float>(std::clamp(progress, 0.0, 1.0))});
  }
  return cells;
}

}  // namespace lararium::player
