#pragma once

// Bundle adjustment of a new session against an existing map that stays fixed.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/reconstruction.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// The camera of a map's images, and its motion in the image of each pose.
struct PosedCameras {
  geometry::CameraModel model;
  Eigen::Vector2d readout = Eigen::Vector2d::Zero();  // See vision::RollingShutter.
  std::vector<ImageMotion> motions;                   // [poses]

  // The raw pixel at which the image of a pose shows a point that is observed at `observed`, whose
  // time counts; nullopt if the camera cannot have seen it.
  std::optional<Eigen::Vector2d> PixelOf(size_t pose,
                                         const geometry::Rigid3& camera_from_map,
                                         const Eigen::Vector3d& point,
                                         const Eigen::Vector2d& observed) const;
};
// Returns the poses and cameras of a map's keyframes.
PosedCameras CamerasOf(const vision::SceneDatabase& map);

// Adjusts the poses from index first_free on, and the points that they observe: minimises Cauchy's
// loss of the reprojection errors over all observations of these points. Earlier poses, and with
// them the map's frame and unit, stay fixed. observations index camera_from_map and points. Runs in
// one thread, so that the same input gives the same bits. Returns false and changes nothing if no
// solution was found.
bool AdjustSession(const PosedCameras& cameras,
                   std::span<const vision::Observation> observations,
                   size_t first_free,
                   std::span<geometry::Rigid3> camera_from_map,
                   std::span<Eigen::Vector3d> points);

// Adjusts only the points i with moves[i], by the same loss; all poses stay fixed.
bool AdjustPoints(const PosedCameras& cameras,
                  std::span<const vision::Observation> observations,
                  std::span<const geometry::Rigid3> camera_from_map,
                  const std::vector<bool>& moves,
                  std::span<Eigen::Vector3d> points);

}  // namespace lararium::train
