#pragma once

// The floor of a trained place: the lowest large level surface among its points.

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "shared/vision/scene_database.h"

namespace lararium::train {

// All in map coordinates and units.
struct FloorPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  // unit, upwards
  double offset = 0.0;                                // normal . x = offset on the floor
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // on the plane, amid its points
  double radius = 0.0;                                // root mean square distance from there
  int points = 0;                                     // that lie on it
  double spread = 0.0;                                // their robust standard deviation about it
  // Standard deviation of its tilt, radians, about the axis that is known worst.
  // Neighbouring points err together: patches of them count, not points.
  double tilt_deviation = 0.0;

  double Height(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
};

// Up is known roughly from the cameras, which people hold upright. RANSAC over
// points that lie close together finds the direction in which the largest level
// surfaces face, table tops and floor alike; the floor is the lowest of them that
// has a fair share of the largest one's area, and is then fitted by itself with
// Tukey's weights. Area counts, not points: a richly painted table has more
// points than a plain floor. nullopt where nothing level is large enough.
std::optional<FloorPlane> FindFloor(const vision::SceneDatabase& database, uint64_t seed = 1);

}  // namespace lararium::train
