#pragma once

// Bundle adjustment of a new session against an existing map that stays fixed.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// Adjusts the poses from index first_free on, and the points that they observe: minimises Cauchy's
// loss of the reprojection errors over all observations of these points. Earlier poses, and with
// them the map's frame and unit, stay fixed. observations index camera_from_map and points. Runs in
// one thread, so that the same input gives the same bits. map supplies the camera, and the motion
// of the keyframes that it has. Returns false and changes nothing if no solution was found.
bool AdjustSession(const vision::SceneDatabase& map,
                   std::span<const vision::Observation> observations,
                   size_t first_free,
                   std::span<geometry::Rigid3> camera_from_map,
                   std::span<Eigen::Vector3d> points);

// Adjusts only the points i with moves[i], by the same loss; all poses stay fixed.
bool AdjustPoints(const vision::SceneDatabase& map,
                  std::span<const vision::Observation> observations,
                  std::span<const geometry::Rigid3> camera_from_map,
                  const std::vector<bool>& moves,
                  std::span<Eigen::Vector3d> points);

}  // namespace lararium::train
