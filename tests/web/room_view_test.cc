#include "web/page/room_view.h"

#include <gtest/gtest.h>

#include <array>

namespace lararium::web {
namespace {

// A view to the right of the room's origin that is turned to the left and sees more on its left and
// below.
const Eigen::AngleAxisd kTurn(0.4, Eigen::Vector3d::UnitY());
const Eigen::Vector3d kPosition(0.3, 1.2, -0.1);

std::array<double, RoomView::kNumbers> Numbers() {
  const Eigen::Quaterniond q(kTurn);
  std::array<double, RoomView::kNumbers> numbers = {
      kPosition.x(), kPosition.y(), kPosition.z(), q.x(), q.y(), q.z(), q.w()};
  // Column by column.
  numbers[7] = 1.5;
  numbers[12] = 2.0;
  numbers[15] = -0.2;
  numbers[16] = -0.1;
  numbers[17] = -1.0;
  numbers[18] = -1.0;
  numbers[21] = -0.2;
  numbers[23] = 640.0;
  numbers[25] = 640.0;
  numbers[26] = 480.0;
  return numbers;
}

TEST(RoomView, ProjectsAPointOfTheRoomToThePixelWhereWebXrDrawsIt) {
  const auto numbers = Numbers();
  const RoomView view = RoomView::FromNumbers(numbers);
  const Eigen::Vector3d point(-0.6, 0.9, -3.0);  // WebXR's axes
  const Eigen::Vector3d in_eye = kTurn.inverse() * (point - kPosition);
  const Eigen::Map<const Eigen::Matrix4d> projection(&numbers[7]);
  const Eigen::Vector4d clip = projection * in_eye.homogeneous();
  const Eigen::Vector2d drawn((0.5 + 0.5 * clip.x() / clip.w()) * 640.0 - 0.5,
                              (0.5 - 0.5 * clip.y() / clip.w()) * 480.0 - 0.5);
  const Eigen::Vector3d seen =
      view.room_from_eye.Inverse() * Eigen::Vector3d(point.x(), -point.y(), -point.z());
  const geometry::CameraModel& camera = view.camera;
  EXPECT_NEAR(camera.fx * seen.x() / seen.z() + camera.cx, drawn.x(), 1e-9);
  EXPECT_NEAR(camera.fy * seen.y() / seen.z() + camera.cy, drawn.y(), 1e-9);
  EXPECT_EQ(view.corner, (std::array{640, 0}));
  EXPECT_TRUE(camera.Validate().ok());
}

}  // namespace
}  // namespace lararium::web
