#pragma once

// A place with known points and cameras, and the matches that its images would give.

#include <Eigen/Core>
#include <vector>

#include "editor/train/reconstruction.h"
#include "editor/train/tracks.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::train::synthetic {

struct WorldOptions {
  int images = 12;
  int points = 400;
  double arc = 1.0;          // Arc of the cameras around the place, radians; 0: they only turn.
  double noise_px = 0.3;     // Standard deviation of each coordinate.
  double false_share = 0.0;  // Share of observations that are moved to random pixels.
  bool planar = false;
  uint64_t seed = 1;
};

struct World {
  geometry::CameraModel camera;
  std::vector<geometry::Rigid3> camera_from_world;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<Eigen::Vector2d>> pixels;  // [image][feature]
  std::vector<std::vector<uint32_t>> point_of;       // [image][feature]

  std::vector<uint32_t> FeatureCounts() const;
  // Matches of all pairs up to `gap` images apart, with two-view geometry as training finds it.
  std::vector<VerifiedPair> Pairs(uint32_t gap, const geometry::CameraModel& assumed) const;
  // An unsolved reconstruction from the tracks of pairs.
  Reconstruction Unsolved(const std::vector<VerifiedPair>& pairs,
                          const geometry::CameraModel& assumed) const;
  // Mean distance of the located camera centres from the true ones after alignment by the best
  // similarity, in world units; infinite if that cannot be found.
  double CenterError(const Reconstruction& reconstruction) const;
};

// Points within a cube of side 2 (or on a plane through it). The cameras look at its middle from an
// arc at a distance of about 4 and at varying heights.
World MakeWorld(const WorldOptions& options);

}  // namespace lararium::train::synthetic
