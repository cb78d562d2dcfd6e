#pragma once

// Once a pose is known, map points are looked for where they should be: more
// matches than the search without a prior, hence a better pose.

#include <Eigen/Core>
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
  static constexpr int kCell = 8;  // pixels
  static constexpr uint32_t kNone = 0xffffffff;

  void FillGrid(const geometry::CameraModel& camera, const Features& features);
  bool Faces(size_t point, const Eigen::Vector3f& camera_in_map) const;
  uint32_t Distance(size_t point, const Descriptor& descriptor) const;
  // The best feature near the point's place, kNone without.
  FeatureMatch BestNear(size_t point,
                        const Eigen::Vector2f& pixel,
                        float expected_scale,
                        float radius_px,
                        const Features& features) const;

  const SceneDatabase& database_;
  std::vector<float> point_scales_;  // sigma of a point's features in map units; 0: unknown

  // Features by cells of the image: lists linked through next_.
  int columns_ = 0;
  int rows_ = 0;
  std::vector<uint32_t> first_;
  std::vector<uint32_t> next_;
  std::vector<FeatureMatch> best_of_feature_;
};

}  // namespace lararium::vision
