#include "editor/panels/viewport/place_picking.h"

#include <algorithm>
#include <limits>

#include "editor/panels/viewport/gizmo.h"

namespace lararium::panels {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::optional<uint32_t> PointBelow(std::span<const Eigen::Vector3f> points_in_world,
                                   const ViewCamera& view,
                                   const Vector2d& pixel,
                                   double near_px,
                                   double reach_px) {
  std::optional<uint32_t> below;
  std::optional<uint32_t> beside;
  double least_depth = std::numeric_limits<double>::infinity();
  double least_distance = reach_px;
  for (uint32_t i = 0; i < points_in_world.size(); ++i) {
    const Vector3d point = view.camera_from_world * points_in_world[i].cast<double>();
    if (point.z() < ViewCamera::kNear) {
      continue;
    }
    const double distance = (view.PixelOf(point) - pixel).norm();
    if (distance <= near_px && point.z() < least_depth) {
      least_depth = point.z();
      below = i;
    } else if (distance < least_distance) {
      least_distance = distance;
      beside = i;
    }
  }
  return below ? below : beside;
}

void ChoosePoint(std::optional<uint32_t> point, bool add, std::vector<uint32_t>& chosen) {
  if (!add || !point) {
    chosen.clear();
  }
  chosen.resize(std::min<size_t>(chosen.size(), 1));
  if (point && (chosen.empty() || chosen.front() != *point)) {
    chosen.push_back(*point);
  }
}

Frustum::Frustum(const geometry::CameraModel& camera,
                 const geometry::Rigid3& camera_from_world,
                 double depth) {
  const geometry::Rigid3 world_from_camera = camera_from_world.Inverse();
  const double half_x = 0.5 * camera.width / camera.fx * depth;
  const double half_y = 0.5 * camera.height / camera.fy * depth;
  eye = world_from_camera.translation;
  corners[0] = world_from_camera * Vector3d(-half_x, -half_y, depth);
  corners[1] = world_from_camera * Vector3d(half_x, -half_y, depth);
  corners[2] = world_from_camera * Vector3d(half_x, half_y, depth);
  corners[3] = world_from_camera * Vector3d(-half_x, half_y, depth);
}

double DistancePx(const Frustum& frustum, const ViewCamera& view, const Vector2d& pixel) {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  const std::optional<Vector2d> eye = view.Project(frustum.eye);
  Vector2d corners[4];
  for (int i = 0; i < 4; ++i) {
    const std::optional<Vector2d> corner = view.Project(frustum.corners[i]);
    if (!corner || !eye) {
      return kNowhere;
    }
    corners[i] = *corner;
  }
  double distance = kNowhere;
  for (int i = 0; i < 4; ++i) {
    distance = std::min({distance, DistanceToSegment(pixel, *eye, corners[i]),
                         DistanceToSegment(pixel, corners[i], corners[(i + 1) % 4])});
  }
  return distance;
}

}  // namespace lararium::panels
