#pragma once

// Guided matching: with a known pose, map points are searched near their projections. This gives
// more matches than the search without a prior, and therefore a better pose.

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
  uint32_t squared_distance = 0;  // Squared distance between the descriptors.
};

class GuidedMatcher {
 public:
  // The database must outlive the matcher.
  explicit GuidedMatcher(const SceneDatabase& database);

  // Matches points that face the camera and project within radius_px of a feature of similar scale
  // and descriptor. Each feature and each point occurs at most once; matches are in the order of
  // the features.
  void Match(const geometry::CameraModel& camera,
             const geometry::Rigid3& camera_from_map,
             const Features& features,
             double radius_px,
             std::vector<FeatureMatch>& matches);

  // Number of points with or without a look-alike that the last Match() looked for in the image.
  size_t searched(bool lookalikes) const { return searched_[lookalikes ? 1 : 0]; }

 private:
  // A copy of the properties that decide whether a point may be visible.
  struct Candidate {
    Eigen::Vector3f position;
    Eigen::Vector3f normal;
    float scale = 0.0f;  // Sigma of the point's keypoints, in map units; 0 if unknown.
    uint32_t point = 0;
  };
  // Neighbouring points that are culled together, so that the run time depends on the visible part
  // of the map and not on its size.
  struct Cluster {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    float radius = 0.0f;
    float largest_scale = 0.0f;  // Largest Candidate::scale; infinite if one is unknown.
    uint32_t begin = 0;          // Range of candidates_.
    uint32_t end = 0;
  };
  static constexpr int kCell = 8;  // pixels

  void BuildClusters();
  void AddCluster(std::span<const uint32_t> points, std::span<const float> scales);
  static constexpr uint32_t kNone = 0xffffffff;

  void FillGrid(const geometry::CameraModel& camera, const Features& features);
  // Computes the inward normals of the four planes through the camera centre and the image's sides.
  void FillSides(const geometry::CameraModel& camera);
  bool MayShow(const Cluster& cluster, const Eigen::Vector3f& centre_in_camera) const;
  uint32_t Distance(size_t point, const Descriptor& descriptor) const;
  // The most similar feature near the point's projection; its `feature` is kNone if there is none.
  FeatureMatch BestNear(size_t point,
                        const Eigen::Vector2f& pixel,
                        float expected_scale,
                        float radius_px,
                        const Features& features) const;

  const SceneDatabase& database_;
  std::vector<Candidate> candidates_;  // Ordered by cluster.
  std::vector<Cluster> clusters_;
  std::array<Eigen::Vector3f, 4> sides_;
  float focal_ = 1.0f;
  float least_scale_ = 0.0f;  // Smallest keypoint scale in the image, pixels.

  // Features by image cell: first_[cell] starts a list that is linked through next_[feature].
  int columns_ = 0;
  int rows_ = 0;
  std::vector<uint32_t> first_;
  std::vector<uint32_t> next_;
  std::vector<FeatureMatch> best_of_feature_;
  std::array<size_t, 2> searched_ = {0, 0};
};

}  // namespace lararium::vision
