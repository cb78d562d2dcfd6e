#pragma once

// A world with ground truth and without photographs: points around the origin with distinct
// descriptors, and cameras on an arc around them.

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
  std::vector<Eigen::Vector3d> points;               // Metres, within 1 m of the origin.
  std::vector<Eigen::Vector3d> normals;              // Directed towards the arc of cameras.
  std::vector<double> sizes;                         // Sigma of the points' features, metres.
  std::vector<vision::Descriptor> descriptors;       // One for each point, of length 512.
  std::vector<geometry::Rigid3> cameras_from_world;  // 4 m away, looking at the origin.
};

SyntheticWorld MakeSyntheticWorld(const SyntheticWorldOptions& options);

struct SyntheticViewOptions {
  double noise_px = 0.0;  // Standard deviation of normal noise along each axis.
  // Share of features at random positions with descriptors of real points.
  double outlier_share = 0.0;
  double descriptor_noise = 10.0;  // Standard deviation of each component.
  uint64_t seed = 1;
};

// The features of a camera's image, in random order.
struct SyntheticView {
  vision::Features features;
  std::vector<int> points;  // Point of each feature; -1: outlier.
};

SyntheticView RenderView(const SyntheticWorld& world,
                         const geometry::Rigid3& camera_from_world,
                         const SyntheticViewOptions& options);

// Appends the features of `more` to `features`.
void Append(const vision::Features& more, vision::Features& features);

// The result of training with exact poses and positions: every camera of the path is a keyframe.
vision::SceneDatabase MakeSceneDatabase(const SyntheticWorld& world);

// The smallest .larscene: one point without observations. focal distinguishes one map from another.
std::vector<std::byte> OnePointScene(double focal);

// The pose of a camera at `centre` in world coordinates, looking at target, with the world's +y
// upwards in the image.
geometry::Rigid3 LookAt(const Eigen::Vector3d& centre, const Eigen::Vector3d& target);

// A random unit descriptor times 512, non-negative like those of images.
vision::Descriptor RandomDescriptor(Random& random);

}  // namespace lararium::test
