#include "editor/panels/viewport/orbit_keys.h"

namespace lararium::panels {

namespace {

using Eigen::Vector2d;

constexpr double kTurn = 1.0 / 72.0;       // Share of a full turn.
constexpr double kShiftStep = 1.0 / 20.0;  // Share of the view's height.

// The direction in which the eye moves; y points down.
Vector2d DirectionOf(KeyAction action) {
  switch (action) {
    case KeyAction::kOrbitLeft:
      return {-1, 0};
    case KeyAction::kOrbitRight:
      return {1, 0};
    case KeyAction::kOrbitUp:
      return {0, -1};
    case KeyAction::kOrbitDown:
      return {0, 1};
    default:
      return Vector2d::Zero();
  }
}

}  // namespace

bool OrbitByKey(KeyAction action, bool shift, const Vector2d& view_size_px, OrbitCamera& orbit) {
  if (action == KeyAction::kComeNearer || action == KeyAction::kGoFurther) {
    orbit.Zoom(action == KeyAction::kComeNearer ? 1.0 : -1.0);
    return true;
  }
  // A drag moves the world in the opposite direction.
  const Vector2d drag = -DirectionOf(action);
  if (drag.isZero()) {
    return false;
  }
  if (shift) {
    orbit.Pan(drag * kShiftStep * view_size_px.y(), view_size_px.y());
  } else {
    orbit.Orbit(drag * kTurn * view_size_px.x(), view_size_px.x());
  }
  return true;
}

}  // namespace lararium::panels
