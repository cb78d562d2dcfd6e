#include "tests/support/synthetic_world.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace lararium::test {
namespace {

using geometry::Rigid3;
using vision::Descriptor;
using vision::Keypoint;

constexpr double kDistance = 4.0;  // Metres, from the cameras to the origin.

Descriptor Quantise(std::array<double, vision::kDescriptorSize> values) {
  double square = 0.0;
  for (double& value : values) {
    value = std::max(value, 0.0);
    square += value * value;
  }
  const double scale = 512.0 / std::sqrt(square);
  Descriptor descriptor;
  for (size_t i = 0; i < values.size(); ++i) {
    descriptor[i] = static_cast<uint8_t>(std::clamp(values[i] * scale + 0.5, 0.0, 255.0));
  }
  return descriptor;
}

Descriptor Disturbed(const Descriptor& descriptor, double noise, Random& random) {
  std::array<double, vision::kDescriptorSize> values;
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = descriptor[i] + noise * random.Normal();
  }
  return Quantise(values);
}

Keypoint KeypointAt(const Eigen::Vector2d& pixel, double scale) {
  Keypoint keypoint;
  keypoint.x = static_cast<float>(pixel.x());
  keypoint.y = static_cast<float>(pixel.y());
  keypoint.scale = static_cast<float>(scale);
  keypoint.response = 0.05f;
  return keypoint;
}

void Shuffle(SyntheticView& view, Random& random) {
  for (size_t i = view.points.size(); i > 1; --i) {
    const size_t j = random.Below(static_cast<uint32_t>(i));
    std::swap(view.points[i - 1], view.points[j]);
    std::swap(view.features.keypoints[i - 1], view.features.keypoints[j]);
    std::swap(view.features.descriptors[i - 1], view.features.descriptors[j]);
  }
}

}  // namespace

Descriptor RandomDescriptor(Random& random) {
  std::array<double, vision::kDescriptorSize> values;
  for (double& value : values) {
    value = random.Normal();
  }
  return Quantise(values);
}

Rigid3 LookAt(const Eigen::Vector3d& centre, const Eigen::Vector3d& target) {
  Eigen::Matrix3d rotation;
  rotation.row(2) = (target - centre).normalized().transpose();
  rotation.row(0) = rotation.row(2).cross(Eigen::RowVector3d::UnitY()).normalized();
  rotation.row(1) = rotation.row(2).cross(rotation.row(0));
  return Rigid3::FromMatrix(rotation, -(rotation * centre));
}

SyntheticWorld MakeSyntheticWorld(const SyntheticWorldOptions& options) {
  Random random(options.seed);
  SyntheticWorld world;
  world.camera = {.width = 640,
                  .height = 480,
                  .fx = 560.0,
                  .fy = 555.0,
                  .cx = 322.0,
                  .cy = 236.0,
                  .k1 = -0.08,
                  .k2 = 0.02,
                  .p1 = 0.001,
                  .p2 = -0.0005};
  for (int i = 0; i < options.points; ++i) {
    world.points.push_back(
        {random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0)});
    world.normals.emplace_back(
        Eigen::Vector3d{random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), 1.0}.normalized());
    world.sizes.push_back(0.01 * std::exp2(random.Uniform(0.0, 3.0)));
    world.descriptors.push_back(RandomDescriptor(random));
  }
  for (int i = 0; i < options.cameras; ++i) {
    const double angle = -0.5 + 1.0 * i / std::max(options.cameras - 1, 1);
    const Eigen::Vector3d centre(kDistance * std::sin(angle), 0.4 * std::sin(3.0 * angle),
                                 kDistance * std::cos(angle));
    world.cameras_from_world.push_back(LookAt(centre, Eigen::Vector3d::Zero()));
  }
  return world;
}

SyntheticView RenderView(const SyntheticWorld& world,
                         const Rigid3& camera_from_world,
                         const SyntheticViewOptions& options) {
  Random random(options.seed);
  SyntheticView view;
  for (size_t i = 0; i < world.points.size(); ++i) {
    const Eigen::Vector3d p = camera_from_world * world.points[i];
    const auto pixel = world.camera.Project(p);
    const Eigen::Vector2d noise{options.noise_px * random.Normal(),
                                options.noise_px * random.Normal()};
    const bool outlier = random.Uniform() < options.outlier_share;
    const Eigen::Vector2d anywhere{random.Uniform(0.0, world.camera.width - 1.0),
                                   random.Uniform(0.0, world.camera.height - 1.0)};
    const Descriptor descriptor = Disturbed(world.descriptors[i], options.descriptor_noise, random);
    if (!pixel || !world.camera.Contains(*pixel)) {
      continue;
    }
    const double scale = world.sizes[i] * world.camera.Focal() / p.z();
    view.features.keypoints.push_back(
        KeypointAt(outlier ? anywhere : Eigen::Vector2d(*pixel + noise), scale));
    view.features.descriptors.push_back(descriptor);
    view.points.push_back(outlier ? -1 : static_cast<int>(i));
  }
  Shuffle(view, random);
  return view;
}

vision::SceneDatabase MakeSceneDatabase(const SyntheticWorld& world) {
  vision::SceneDatabase db;
  db.camera = world.camera;
  db.descriptor_begin.push_back(0);
  for (size_t i = 0; i < world.points.size(); ++i) {
    db.points.push_back(world.points[i].cast<float>());
    db.normals.push_back(world.normals[i].cast<float>());
    db.observation_counts.push_back(static_cast<uint32_t>(world.cameras_from_world.size()));
    db.session_masks.push_back(1);
    db.descriptors.push_back(world.descriptors[i]);
    db.descriptor_point.push_back(static_cast<uint32_t>(i));
    db.descriptor_begin.push_back(static_cast<uint32_t>(i + 1));
  }
  for (size_t k = 0; k < world.cameras_from_world.size(); ++k) {
    const Rigid3& pose = world.cameras_from_world[k];
    vision::Keyframe keyframe;
    keyframe.frame_index = static_cast<int64_t>(k);
    keyframe.name = std::to_string(k) + ".png";
    keyframe.camera_from_map = pose;
    keyframe.grey = cv::Mat(world.camera.height, world.camera.width, CV_8UC1, cv::Scalar(128));
    db.keyframes.push_back(keyframe);
    for (size_t i = 0; i < world.points.size(); ++i) {
      const Eigen::Vector3d p = pose * world.points[i];
      const auto pixel = world.camera.Project(p);
      if (pixel && world.camera.Contains(*pixel)) {
        db.observations.push_back(
            {static_cast<uint32_t>(i), static_cast<uint32_t>(k), static_cast<float>(pixel->x()),
             static_cast<float>(pixel->y()),
             static_cast<float>(world.sizes[i] * world.camera.Focal() / p.z())});
      }
    }
  }
  db.forest = vision::BuildForest(db.descriptors, {});
  return db;
}

std::vector<std::byte> OnePointScene(double focal) {
  vision::SceneDatabase database;
  database.camera = {64, 48, focal, focal, 32.0, 24.0};
  database.points = {{0.0f, 0.0f, 2.0f}};
  database.normals = {{0.0f, 0.0f, -1.0f}};
  database.observation_counts = {2};
  database.session_masks = {1};
  database.descriptor_begin = {0, 1};
  database.descriptors.resize(1);
  database.descriptor_point = {0};
  database.forest = vision::BuildForest(database.descriptors, {});
  return vision::SerializeSceneDatabase(database);
}

void Append(const vision::Features& more, vision::Features& features) {
  features.keypoints.insert(features.keypoints.end(), more.keypoints.begin(), more.keypoints.end());
  features.descriptors.insert(features.descriptors.end(), more.descriptors.begin(),
                              more.descriptors.end());
}

}  // namespace lararium::test
