#pragma once

// A world with ground truth and no photographs: points around the origin with
// descriptors that tell them apart, and cameras on an arc around them.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/core/random.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"

namespace lararium::test {

struct SyntheticWorldOptions {
  int points = 400;
  int cameras = 12;
  uint64_t seed = 1;
};

struct SyntheticWorld {
  geometry::CameraModel camera;
  std::vector<Eigen::Vector3d> points;               // metres, within 1 m of the origin
  std::vector<Eigen::Vector3d> normals;              // towards the arc of cameras
  std::vector<double> sizes;                         // sigma of the features they give, metres
  std::vector<vision::Descriptor> descriptors;       // one for each point, of length 512
  std::vector<geometry::Rigid3> cameras_from_world;  // 4 m away, looking at the origin
};

SyntheticWorld MakeSyntheticWorld(const SyntheticWorldOptions& options);

struct SyntheticViewOptions {
  double noise_px = 0.0;           // normal, along each axis
  double outlier_share = 0.0;      // features at random places with descriptors of real points
  double descriptor_noise = 10.0;  // standard deviation of each component
  uint64_t seed = 1;
};

// What a camera sees: features in random order.
struct SyntheticView {
  vision::Features features;
  std::vector<int> points;  // of the features; -1: outlier
};

SyntheticView RenderView(const SyntheticWorld& world,
                         const geometry::Rigid3& camera_from_world,
                         const SyntheticViewOptions& options);

// The features of more after those of features.
void Append(const vision::Features& more, vision::Features& features);

// What training would give with exact poses and places: every camera of the path
// is a keyframe.
vision::SceneDatabase MakeSceneDatabase(const SyntheticWorld& world);

// The smallest .larscene: one point that nobody saw; focal tells one from another.
std::vector<std::byte> OnePointScene(double focal);

// The pose at a camera centre in world coordinates, looking at target, with the
// world's +y upwards in the image.
geometry::Rigid3 LookAt(const Eigen::Vector3d& centre, const Eigen::Vector3d& target);

// A random unit descriptor times 512, non-negative like those of images.
vision::Descriptor RandomDescriptor(Random& random);

}  // namespace lararium::test
