#include "editor/panels/viewport/view_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lararium::panels {

std::optional<Eigen::Vector2d> ViewCamera::Project(const Eigen::Vector3d& point_in_world) const {
  const Eigen::Vector3d point = camera_from_world * point_in_world;
  if (point.z() < kNear) {
    return std::nullopt;
  }
  return PixelOf(point);
}

Ray ViewCamera::RayThrough(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector3d in_camera((pixel.x() - center.x()) / focal_x,
                                  (pixel.y() - center.y()) / focal_y, 1.0);
  return {camera_from_world.Center(),
          camera_from_world.rotation.conjugate() * in_camera.normalized()};
}

double ViewCamera::UnitsPerPixel(const Eigen::Vector3d& point_in_world) const {
  return std::max((camera_from_world * point_in_world).z(), kNear) / focal_y;
}

std::optional<Ball> BallAround(std::span<const Eigen::Vector3f> points) {
  constexpr double kMost = 0.95;
  if (points.empty()) {
    return std::nullopt;
  }
  const auto share_of = [](std::vector<float>& values, double share) {
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return static_cast<double>(values[static_cast<size_t>(at)]);
  };
  Ball ball;
  std::vector<float> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(),
                   [axis](const Eigen::Vector3f& point) { return point[axis]; });
    ball.center[axis] = share_of(values, 0.5);
  }
  std::transform(points.begin(), points.end(), values.begin(), [&](const Eigen::Vector3f& point) {
    return static_cast<float>((point.cast<double>() - ball.center).norm());
  });
  ball.radius = share_of(values, kMost);
  return ball;
}

void OrbitCamera::Orbit(const Eigen::Vector2d& drag_px, double view_width_px) {
  constexpr double kMaxElevation = 1.55;
  const double radians_per_px = 2.0 * std::numbers::pi / std::max(view_width_px, 1.0);
  azimuth = std::remainder(azimuth - drag_px.x() * radians_per_px, 2.0 * std::numbers::pi);
  elevation = std::clamp(elevation + drag_px.y() * radians_per_px, -kMaxElevation, kMaxElevation);
}

void OrbitCamera::Pan(const Eigen::Vector2d& drag_px, double view_height_px) {
  const double units_per_px =
      2.0 * distance * std::tan(0.5 * kVerticalFieldOfView) / std::max(view_height_px, 1.0);
  const Eigen::Quaterniond world_from_camera = CameraFromWorld().rotation.conjugate();
  target -= world_from_camera * Eigen::Vector3d(drag_px.x(), drag_px.y(), 0.0) * units_per_px;
}

void OrbitCamera::Zoom(double steps) {
  distance = std::clamp(distance * std::pow(0.85, steps), kNearest, kFarthest);
}

void OrbitCamera::LookAt(const Ball& ball, const Eigen::Vector2d& view_size_px) {
  const double ratio = view_size_px.x() / std::max(view_size_px.y(), 1.0);
  const double slope = std::tan(0.5 * kVerticalFieldOfView) * std::min(ratio, 1.0);
  target = ball.center;
  distance = std::clamp(ball.radius / std::sin(std::atan(slope)), kNearest, kFarthest);
}

geometry::Rigid3 OrbitCamera::CameraFromWorld() const {
  const Eigen::Quaterniond world_from_orbit =
      Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(-elevation, Eigen::Vector3d::UnitX());
  // Orbit axes are x right, y up, z backward: the camera's axes after half a turn about x.
  const Eigen::Quaterniond camera_from_orbit(0.0, 1.0, 0.0, 0.0);
  const Eigen::Quaterniond camera_from_world =
      (camera_from_orbit * world_from_orbit.conjugate()).normalized();
  const Eigen::Vector3d center = target + world_from_orbit * Eigen::Vector3d(0, 0, distance);
  return {camera_from_world, -(camera_from_world * center)};
}

ViewCamera OrbitCamera::View(const Eigen::Vector2d& origin, const Eigen::Vector2d& size_px) const {
  const double focal = 0.5 * size_px.y() / std::tan(0.5 * kVerticalFieldOfView);
  return {CameraFromWorld(), focal, focal, origin + 0.5 * size_px};
}

}  // namespace lararium::panels
