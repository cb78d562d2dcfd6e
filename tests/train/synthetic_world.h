#pragma once

// A place with known points and cameras, and what matching would see of it.

#include <Eigen/Core>
#include <vector>

#include "editor/train/reconstruction.h"
#include "editor/train/tracks.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::train::test {

struct WorldOptions {
  int images = 12;
  int points = 400;
  double arc = 1.0;          // radians that the cameras cover around the place; 0: they only turn
  double noise_px = 0.3;     // standard deviation of each coordinate
  double false_share = 0.0;  // of sights, moved to random pixels
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
  // Matches of all pairs up to gap images apart, with two-view geometry as
  // training finds it.
  std::vector<VerifiedPair> Pairs(uint32_t gap, const geometry::CameraModel& assumed) const;
  // An unsolved reconstruction over the tracks of pairs.
  Reconstruction Unsolved(const std::vector<VerifiedPair>& pairs,
                          const geometry::CameraModel& assumed) const;
  // Mean distance of located camera centres from the true ones after the best
  // similarity, in world units; infinite when it cannot be found.
  double CenterError(const Reconstruction& reconstruction) const;
};

// Points within a cube of side 2 (or on a plane through it), cameras about 4 away
// on an arc at varying height, looking at its middle.
World MakeWorld(const WorldOptions& options);

}  // namespace lararium::train::test
