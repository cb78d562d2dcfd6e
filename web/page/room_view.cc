#include "web/page/room_view.h"

namespace lararium::web {

geometry::Rigid3 RoomFromEye(std::span<const double> numbers) {
  const auto position = numbers.first<3>();
  const auto orientation = numbers.subspan<3, 4>();
  return {Eigen::Quaterniond(orientation[3], orientation[0], -orientation[1], -orientation[2])
              .normalized(),
          Eigen::Vector3d(position[0], -position[1], -position[2])};
}

RoomView RoomView::FromNumbers(std::span<const double> numbers) {
  const auto projection = numbers.subspan<7, 16>();
  const auto viewport = numbers.subspan<23, 4>();
  RoomView view;
  view.room_from_eye = RoomFromEye(numbers);
  view.corner = {static_cast<int>(viewport[0]), static_cast<int>(viewport[1])};
  geometry::CameraModel& camera = view.camera;
  camera.width = static_cast<int>(viewport[2]);
  camera.height = static_cast<int>(viewport[3]);
  // The matrix maps to -1..1 with y up; pixels count from the centre of the upper left one.
  camera.fx = 0.5 * camera.width * projection[0];
  camera.fy = 0.5 * camera.height * projection[5];
  camera.cx = 0.5 * camera.width * (1.0 - projection[8]) - 0.5;
  camera.cy = 0.5 * camera.height * (1.0 + projection[9]) - 0.5;
  return view;
}

}  // namespace lararium::web
