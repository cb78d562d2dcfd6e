#include "tests/train/synthetic_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "editor/train/two_view.h"
#include "shared/core/random.h"

namespace lararium::train::synthetic {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

// The pose of a camera at center whose axis points at target, with y down.
Rigid3 LookAt(const Eigen::Vector3d& center, const Eigen::Vector3d& target) {
  const Eigen::Vector3d z = (target - center).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d(0, 1, 0).cross(z).normalized();
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
  return Rigid3::FromMatrix(rotation, -rotation * center);
}

Rigid3 CameraAt(const WorldOptions& options, int i) {
  const double t = options.images > 1 ? static_cast<double>(i) / (options.images - 1) : 0.0;
  if (options.arc == 0.0) {
    return LookAt({0, 0, -4}, {0.6 * (t - 0.5), 0.2 * std::sin(5.0 * t), 0});
  }
  const double angle = options.arc * (t - 0.5);
  return LookAt({4.0 * std::sin(angle), 0.3 * std::sin(7.0 * t), -4.0 * std::cos(angle)},
                // If all cameras look at one point, the focal length is not determined.
                {0.3 * std::sin(4.0 * i), 0.3 * std::cos(3.0 * i), 0});
}

}  // namespace

World MakeWorld(const WorldOptions& options) {
  Random random(options.seed);
  World world;
  world.camera.width = 640;
  world.camera.height = 480;
  world.camera.fx = world.camera.fy = 600.0;
  world.camera.cx = 319.5;
  world.camera.cy = 239.5;
  for (int i = 0; i < options.points; ++i) {
    world.points.push_back({random.Uniform(-1, 1), random.Uniform(-1, 1),
                            options.planar ? 0.0 : random.Uniform(-1, 1)});
  }
  for (int i = 0; i < options.images; ++i) {
    world.camera_from_world.push_back(CameraAt(options, i));
    auto& pixels = world.pixels.emplace_back();
    auto& point_of = world.point_of.emplace_back();
    for (uint32_t p = 0; p < world.points.size(); ++p) {
      auto pixel = world.camera.Project(world.camera_from_world[i] * world.points[p]);
      if (!pixel || !world.camera.Contains(*pixel)) {
        continue;
      }
      *pixel += options.noise_px * Eigen::Vector2d{random.Normal(), random.Normal()};
      if (random.Uniform() < options.false_share) {
        *pixel = {random.Uniform(0, 640), random.Uniform(0, 480)};
      }
      pixels.push_back(*pixel);
      point_of.push_back(p);
    }
  }
  return world;
}

std::vector<uint32_t> World::FeatureCounts() const {
  std::vector<uint32_t> counts;
  for (const auto& features : pixels) {
    counts.push_back(static_cast<uint32_t>(features.size()));
  }
  return counts;
}

std::vector<VerifiedPair> World::Pairs(uint32_t gap, const CameraModel& assumed) const {
  std::vector<VerifiedPair> pairs;
  for (uint32_t a = 0; a < pixels.size(); ++a) {
    std::map<uint32_t, uint32_t> feature_of;
    for (uint32_t f = 0; f < point_of[a].size(); ++f) {
      feature_of[point_of[a][f]] = f;
    }
    for (uint32_t b = a + 1; b < std::min<size_t>(pixels.size(), a + gap + 1); ++b) {
      VerifiedPair pair;
      pair.images = {a, b};
      PointPairs plane;
      for (uint32_t f = 0; f < point_of[b].size(); ++f) {
        const auto found = feature_of.find(point_of[b][f]);
        if (found != feature_of.end()) {
          pair.matches.push_back({found->second, f});
          plane.a.push_back(assumed.PlaneFromPixel(pixels[a][found->second]));
          plane.b.push_back(assumed.PlaneFromPixel(pixels[b][f]));
        }
      }
      const auto pose = EstimateRelativePose(plane, 3.0 / assumed.Focal());
      if (pose) {
        pair.b_from_a = pose->b_from_a;
        pair.median_angle = pose->median_angle;
        pairs.push_back(pair);
      }
    }
  }
  return pairs;
}

Reconstruction World::Unsolved(const std::vector<VerifiedPair>& pairs,
                               const CameraModel& assumed) const {
  return Reconstruction(assumed, pixels, BuildTracks(FeatureCounts(), pairs));
}

double World::CenterError(const Reconstruction& reconstruction) const {
  std::vector<Eigen::Vector3d> found;
  std::vector<Eigen::Vector3d> truth;
  for (const uint32_t image : reconstruction.LocatedImages()) {
    found.push_back(reconstruction.camera_from_map(image).Center());
    truth.push_back(camera_from_world[image].Center());
  }
  const auto world_from_map = geometry::EstimateSimilarity(truth, found);
  if (!world_from_map.ok()) {
    return std::numeric_limits<double>::infinity();
  }
  double sum = 0.0;
  for (size_t i = 0; i < found.size(); ++i) {
    sum += (*world_from_map * found[i] - truth[i]).norm();
  }
  return sum / static_cast<double>(found.size());
}

}  // namespace lararium::train::synthetic
