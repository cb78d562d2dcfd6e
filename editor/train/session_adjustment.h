#pragma once

// Bundle adjustment of a new session beside an old one that holds still.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// Moves the poses from first_free on and the points that they observe to where
// the reprojection errors of all observations of these points are least, under
// Cauchy's loss. Poses before first_free, and with them the map's frame and
// unit, hold still. observations index poses and points. One thread: the same
// input gives the same bits. False when no solution was found; nothing has
// changed then.
bool AdjustSession(const geometry::CameraModel& camera,
                   std::span<const vision::Observation> observations,
                   size_t first_free,
                   std::span<geometry::Rigid3> camera_from_map,
                   std::span<Eigen::Vector3d> points);

// Moves the points of which moves is true to where the reprojection errors of their observations
// are least, likewise; all poses hold still.
bool AdjustPoints(const geometry::CameraModel& camera,
                  std::span<const vision::Observation> observations,
                  std::span<const geometry::Rigid3> camera_from_map,
                  const std::vector<bool>& moves,
                  std::span<Eigen::Vector3d> points);

}  // namespace lararium::train
