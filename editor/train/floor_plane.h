#pragma once

// Finds the floor of a trained place: the lowest large horizontal surface among its points.

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "shared/vision/scene_database.h"

namespace lararium::train {

// The floor in map coordinates and map units.
struct FloorPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  // Unit normal, upwards.
  double offset = 0.0;                                // normal . x = offset for points x.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // Mean of the points, on the plane.
  double radius = 0.0;                                // RMS distance of the points from center.
  int points = 0;                                     // Number of points on the floor.
  double spread = 0.0;                                // Robust standard deviation of their heights.
  // Standard deviation of the tilt about its least certain axis, radians. Errors of neighbouring
  // points are correlated, so patches of points are counted, not points.
  double tilt_deviation = 0.0;

  double Height(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
};

// The approximate up direction comes from the cameras, which people hold upright. RANSAC over
// neighbouring points finds the normal of the largest horizontal surfaces, which may be table tops
// or the floor. The floor is the lowest of them whose area is a sufficient share of the largest
// one's, and is then fitted by itself with Tukey's weights. Area counts, not the number of points:
// a richly painted table has more points than a plain floor. nullopt if no horizontal surface is
// large enough.
std::optional<FloorPlane> FindFloor(const vision::SceneDatabase& database, uint64_t seed = 1);

}  // namespace lararium::train
