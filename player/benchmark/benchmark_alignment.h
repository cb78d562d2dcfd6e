#pragma once

// Aligns estimated camera poses with the true ones. The frame and the scale of a map are arbitrary,
// so errors can be measured only after this.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::player {

// One image with its true and its estimated pose.
struct PosePair {
  geometry::CameraModel camera;  // the true camera, used to project with both poses
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

// Converts an estimated pose to the frame and units of the world.
geometry::Rigid3 CameraFromWorld(const geometry::Rigid3& camera_from_map,
                                 const geometry::Similarity3& world_from_map);

// Distances in pixels between true and estimated projections, at most the diagonal of the image.
// A point behind the camera counts as the diagonal.
std::vector<double> RegistrationErrors(std::span<const VisiblePoint> visible,
                                       const geometry::CameraModel& camera,
                                       const geometry::Rigid3& camera_from_world);

struct Alignment {
  geometry::Similarity3 world_from_map;
  std::vector<bool> inliers;  // parallel to pairs: true for those that were used
};

// Aligns the camera centres: least median of squares over triples (Rousseeuw, "Least median of
// squares regression", JASA 1984), then least squares on the inliers. If the centres do not
// determine the rotation (fewer than three, or on a line), the orientations are used. nullopt:
// there are no pairs.
std::optional<Alignment> AlignOnCentres(std::span<const PosePair> pairs);

// Aligns the camera centres, then refines on the inliers the distances between projections of the
// points: Levenberg-Marquardt with Huber's weights. Without this, a few millimetres of noise in the
// centres tilt the frame enough to dominate the error in pixels, although the tilt is only an
// arbitrary choice of frame.
std::optional<Alignment> AlignOnPoints(std::span<const PosePair> pairs,
                                       std::span<const Eigen::Vector3d> points);

}  // namespace lararium::player
