#pragma once

// How a viewport looks at the world: an undistorted pinhole whose pixels are
// those of the window.

#include <Eigen/Core>
#include <optional>
#include <span>

#include "shared/geometry/transform.h"

namespace lararium::panels {

// Half-line from origin along a unit direction.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();

  Eigen::Vector3d At(double distance) const { return origin + distance * direction; }
};

struct ViewCamera {
  geometry::Rigid3 camera_from_world;  // x right, y down, z forward
  double focal_x = 1.0;                // window pixels
  double focal_y = 1.0;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // principal point, window pixels

  static constexpr double kNear = 1e-3;  // world units; nearer points are not drawn

  // Of a point before the camera, in its axes.
  Eigen::Vector2d PixelOf(const Eigen::Vector3d& point_in_camera) const {
    return {center.x() + focal_x * point_in_camera.x() / point_in_camera.z(),
            center.y() + focal_y * point_in_camera.y() / point_in_camera.z()};
  }
  // nullopt behind the near plane.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_world) const;
  Ray RayThrough(const Eigen::Vector2d& pixel) const;
  // Length in world units that covers one pixel at a point.
  double UnitsPerPixel(const Eigen::Vector3d& point_in_world) const;
};

// Something round to look at, in the world.
struct Ball {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1.0;
};

// About most of the points: those that lie far from all others, as maps have some, are left out.
// nullopt: there are none.
std::optional<Ball> BallAround(std::span<const Eigen::Vector3f> points);

// Looks at a target from a distance; the world's +Y is up.
struct OrbitCamera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  double distance = 5.0;
  double azimuth = 0.6;     // radians about +Y; at 0 the camera looks along -Z
  double elevation = 0.45;  // radians above the horizon

  // Turns by a drag of pixels: a full width of the view is one turn.
  void Orbit(const Eigen::Vector2d& drag_px, double view_width_px);
  // Moves the target with the drag, so that it stays below the pointer.
  void Pan(const Eigen::Vector2d& drag_px, double view_height_px);
  // steps > 0 comes nearer.
  void Zoom(double steps);
  // Shows all of a ball in a view of that size, in the middle, from the direction that it looks
  // from already.
  void LookAt(const Ball& ball, const Eigen::Vector2d& view_size_px);

  geometry::Rigid3 CameraFromWorld() const;
  // Pixels: those of a view whose top-left corner lies at origin.
  ViewCamera View(const Eigen::Vector2d& origin, const Eigen::Vector2d& size_px) const;

  static constexpr double kVerticalFieldOfView = 0.8;  // radians
  static constexpr double kNearest = 0.02;             // of distance, world units
  static constexpr double kFarthest = 2000.0;
};

}  // namespace lararium::panels
