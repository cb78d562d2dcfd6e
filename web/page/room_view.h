#pragma once

// A view of a device that shows the real surroundings itself, as WebXR describes it.

#include <array>
#include <span>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::web {

struct RoomView {
  // Position (x, y, z), orientation (x, y, z, w), the projection matrix column by column, and the
  // viewport: x, y of its lower left corner, width and height in pixels.
  static constexpr size_t kNumbers = 27;

  // numbers: kNumbers of them, in WebXR's axes (x right, y up, z backwards).
  static RoomView FromNumbers(std::span<const double> numbers);

  geometry::CameraModel camera;  // A pinhole with the size of the viewport.
  geometry::Rigid3 room_from_eye;
  std::array<int, 2> corner = {};  // Lower left corner of the viewport, pixels.
};

// Axes of the room and of the eye are those of a camera (x right, y down, z forward), so that the
// room's y axis points down. numbers: the first seven of RoomView::kNumbers.
geometry::Rigid3 RoomFromEye(std::span<const double> numbers);

}  // namespace lararium::web
