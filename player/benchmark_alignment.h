#pragma once

// Moves estimated camera poses into the frame of the true ones. A map's frame
// and scale are its own choice, so errors mean something only after this.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::player {

// One image with its true and its estimated pose.
struct PosePair {
  geometry::CameraModel camera;  // the true one: both poses are projected with it
  geometry::Rigid3 camera_from_world;
  geometry::Rigid3 camera_from_map;
};

// A point inside the true image, and its true pixel.
struct VisiblePoint {
  Eigen::Vector3d in_world;
  Eigen::Vector2d pixel;
};
std::vector<VisiblePoint> VisiblePoints(std::span<const Eigen::Vector3d> points,
                                        const geometry::CameraModel& camera,
                                        const geometry::Rigid3& camera_from_world);

// The estimated pose in the world's frame and units.
geometry::Rigid3 CameraFromWorld(const geometry::Rigid3& camera_from_map,
                                 const geometry::Similarity3& world_from_map);

// Distances in pixels between the true and the estimated projections, at most
// the image's diagonal, which is also what a point behind the camera counts as.
std::vector<double> RegistrationErrors(std::span<const VisiblePoint> visible,
                                       const geometry::CameraModel& camera,
                                       const geometry::Rigid3& camera_from_world);

struct Alignment {
  geometry::Similarity3 world_from_map;
  std::vector<bool> inliers;  // [pairs]: what it rests on
};

// From the camera centres: least median of squares over triples (Rousseeuw,
// "Least median of squares regression", JASA 1984), then least squares on the
// inliers. Where the centres do not fix the rotation (fewer than three, or on a
// line) the orientations do. nullopt without pairs.
std::optional<Alignment> AlignOnCentres(std::span<const PosePair> pairs);

// The same, then refined on its inliers until the projections of the points
// agree: Levenberg-Marquardt with Huber's weights. A few millimetres of noise in
// the centres tilt the frame by enough to dominate the error in pixels, although
// the tilt is only a choice of frame.
std::optional<Alignment> AlignOnPoints(std::span<const PosePair> pairs,
                                       std::span<const Eigen::Vector3d> points);

}  // namespace lararium::player
