#pragma once

// The camera of a viewport: an undistorted pinhole whose pixels are those of the window.

#include <Eigen/Core>
#include <optional>
#include <span>

#include "shared/geometry/transform.h"

namespace lararium::panels {

// A half-line from origin in a unit direction.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();

  Eigen::Vector3d At(double distance) const { return origin + distance * direction; }
};

struct ViewCamera {
  geometry::Rigid3 camera_from_world;  // Camera axes x right, y down, z forward.
  double focal_x = 1.0;                // Window pixels.
  double focal_y = 1.0;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // Principal point, window pixels.

  static constexpr double kNear = 1e-3;  // World units; nearer points are not drawn.

  // Projects a point in front of the camera, in camera axes.
  Eigen::Vector2d PixelOf(const Eigen::Vector3d& point_in_camera) const {
    return {center.x() + focal_x * point_in_camera.x() / point_in_camera.z(),
            center.y() + focal_y * point_in_camera.y() / point_in_camera.z()};
  }
  // nullopt where the point is behind the near plane.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_world) const;
  Ray RayThrough(const Eigen::Vector2d& pixel) const;
  // The length, in world units, of one pixel at the depth of a point.
  double UnitsPerPixel(const Eigen::Vector3d& point_in_world) const;
};

// A sphere to look at, in the world.
struct Ball {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1.0;
};

// A sphere around most of the points, without outliers. nullopt: there are no points.
std::optional<Ball> BallAround(std::span<const Eigen::Vector3f> points);

// Looks at a target from a distance; the world's +Y is up.
struct OrbitCamera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  double distance = 5.0;
  double azimuth = 0.6;     // Radians about +Y; at 0 the camera looks along -Z.
  double elevation = 0.45;  // Radians above the horizon.

  // Rotates by a drag in pixels: the width of the view is a full turn.
  void Orbit(const Eigen::Vector2d& drag_px, double view_width_px);
  // Moves the target with the drag, so that it stays under the pointer.
  void Pan(const Eigen::Vector2d& drag_px, double view_height_px);
  // steps > 0 moves closer.
  void Zoom(double steps);
  // Centres a ball and shows all of it in a view of that size, without changing the direction.
  void LookAt(const Ball& ball, const Eigen::Vector2d& view_size_px);

  geometry::Rigid3 CameraFromWorld() const;
  // The camera of a view whose top-left corner lies at origin, in pixels.
  ViewCamera View(const Eigen::Vector2d& origin, const Eigen::Vector2d& size_px) const;

  static constexpr double kVerticalFieldOfView = 0.8;  // Radians.
  static constexpr double kNearest = 0.02;             // Limits of distance, world units.
  static constexpr double kFarthest = 2000.0;
};

}  // namespace lararium::panels
