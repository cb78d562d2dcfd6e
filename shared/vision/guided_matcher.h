#pragma once

// Once a pose is known, map points are looked for where they should be: more
// matches than the search without a prior, hence a better pose.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/features.h"
#include "shared/vision/scene_database.h"

namespace lararium::vision {

// A feature of the image that shows a point of the map.
struct FeatureMatch {
  uint32_t feature = 0;
  uint32_t point = 0;
  uint32_t squared_distance = 0;  // of the descriptors
};

class GuidedMatcher {
 public:
  // Borrows the database for its life.
  explicit GuidedMatcher(const SceneDatabase& database);

  // Points that face the camera and project within radius_px of a feature of
  // similar scale and descriptor; each feature and each point at most once, in
  // order of the features.
  void Match(const geometry::CameraModel& camera,
             const geometry::Rigid3& camera_from_map,
             const Features& features,
             double radius_px,
             std::vector<FeatureMatch>& matches);

 private:
  // A copy of what decides whether a point may be seen.
  struct Candidate {
    Eigen::Vector3f position;
    Eigen::Vector3f normal;
    float scale = 0.0f;  // sigma of its features in map units; 0: unknown
    uint32_t point = 0;
  };
  // Points that lie together, culled together: the time goes with what the
  // camera sees, not with the size of the map.
  struct Cluster {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    float radius = 0.0f;
    float largest_scale = 0.0f;  // of its points; infinite where one is not known
    uint32_t begin = 0;          // into candidates_
    uint32_t end = 0;
  };
  static constexpr int kCell = 8;  // pixels

  void BuildClusters();
  void AddCluster(std::span<const uint32_t> points, std::span<const float> scales);
  static constexpr uint32_t kNone = 0xffffffff;

  void FillGrid(const geometry::CameraModel& camera, const Features& features);
  // Normals of the four planes through the image's sides, inwards.
  void FillSides(const geometry::CameraModel& camera);
  bool MayShow(const Cluster& cluster, const Eigen::Vector3f& centre_in_camera) const;
  uint32_t Distance(size_t point, const Descriptor& descriptor) const;
  // The best feature near the point's place, kNone without.
  FeatureMatch BestNear(size_t point,
                        const Eigen::Vector2f& pixel,
                        float expected_scale,
                        float radius_px,
                        const Features& features) const;

  const SceneDatabase& database_;
  std::vector<Candidate> candidates_;  // by cluster
  std::vector<Cluster> clusters_;
  std::array<Eigen::Vector3f, 4> sides_;
  float focal_ = 1.0f;
  float least_scale_ = 0.0f;  // of the image's features, pixels

  // Features by cells of the image: lists linked through next_.
  int columns_ = 0;
  int rows_ = 0;
  std::vector<uint32_t> first_;
  std::vector<uint32_t> next_;
  std::vector<FeatureMatch> best_of_feature_;
};

}  // namespace lararium::vision
