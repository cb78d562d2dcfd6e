#pragma once

// Cameras on a path through points: their true poses, and poses in a map with a frame, scale and
// noise of its own.

#include <vector>

#include "player/benchmark/benchmark_alignment.h"
#include "player/benchmark/benchmark_sequence.h"
#include "shared/core/random.h"
#include "shared/geometry/transform.h"

namespace lararium::test {

struct BenchmarkWorld {
  geometry::CameraModel camera{640, 480, 500, 500, 319.5, 239.5};
  geometry::Similarity3 world_from_map{
      3.0, geometry::RotationFromVector({0.4, -0.3, 0.9}), {1.0, -2.0, 0.5}};
  std::vector<Eigen::Vector3d> points;  // within 1 m of the origin
  std::vector<player::PosePair> pairs;
};

// Converts a pose of the world to the corresponding pose of the map.
inline geometry::Rigid3 CameraFromMap(const geometry::Rigid3& camera_from_world,
                                      const geometry::Similarity3& world_from_map) {
  return geometry::CameraFromB(camera_from_world, world_from_map);
}

// noise: standard deviation of camera centres in metres; a hundredth of it in radians for
// rotations.
inline BenchmarkWorld MakeBenchmarkWorld(int cameras, double noise, uint64_t seed) {
  BenchmarkWorld world;
  Random random(seed);
  const auto draw = [&](double size) {
    return Eigen::Vector3d{size * random.Normal(), size * random.Normal(), size * random.Normal()};
  };
  for (int i = 0; i < 300; ++i) {
    world.points.push_back({random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)});
  }
  for (int i = 0; i < cameras; ++i) {
    geometry::Rigid3 truth{geometry::RotationFromVector(draw(0.1)),
                           Eigen::Vector3d(0, 0, 4) + draw(0.3)};
    geometry::Rigid3 seen = truth;
    seen.translation += draw(noise);
    seen.rotation = geometry::RotationFromVector(draw(0.01 * noise)) * seen.rotation;
    world.pairs.push_back({world.camera, truth, CameraFromMap(seen, world.world_from_map)});
  }
  return world;
}

}  // namespace lararium::test
