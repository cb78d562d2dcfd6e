#pragma once

// Predicts how well an image taken from any position in the place would be located in the map.

#include <Eigen/Core>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

struct ViewpointPrediction {
  double matches = 0.0;  // Expected number of map points that the image would match.
  // Expected registration error of the resulting pose at the image's worst corner, one sigma, in
  // pixels; infinite if no pose would be found.
  double error_px = 0.0;

  friend bool operator==(const ViewpointPrediction&, const ViewpointPrediction&) = default;
};

enum class ViewpointQuality { kGood, kFair, kPoor, kNone };
ViewpointQuality QualityOf(const ViewpointPrediction& prediction);

// A point counts as visible if it projects into the image and is seen from a direction and distance
// similar to those in training. The share of visible points that is really matched, and the noise
// of an observation, are measured on the keyframes themselves. The pose's covariance is the inverse
// of the information of the expected observations. Occlusion by walls is considered only through
// the directions from which points were observed.
class ViewpointPredictor {
 public:
  // Copies the data that it needs; large maps are thinned out evenly.
  explicit ViewpointPredictor(const vision::SceneDatabase& database);

  ViewpointPrediction Predict(const geometry::Rigid3& camera_from_map) const;

  // Median distance from the keyframes to their points, map units; 0 without points.
  double median_depth() const { return median_depth_; }
  // Standard deviation of an observation along one axis, pixels.
  double noise_px() const { return noise_px_; }

 private:
  struct Point {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
    double min_cosine = 1.0;  // Cosine of the largest angle to the normal for recognition.
    double nearest = 0.0;     // Range of distances for recognition, map units.
    double farthest = 0.0;
  };

  void FillVisible(const geometry::Rigid3& camera_from_map, std::vector<uint32_t>& visible) const;
  void MeasureKeyframes(const vision::SceneDatabase& database, size_t stride);

  geometry::CameraModel camera_;
  std::vector<Point> points_;
  double points_each_ = 1.0;  // Number of map points that each of points_ represents.
  double found_share_ = 1.0;  // Share of visible points that is matched.
  double noise_px_ = 1.0;
  double median_depth_ = 0.0;
};

}  // namespace lararium::train
