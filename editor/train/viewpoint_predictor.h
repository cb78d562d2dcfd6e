#pragma once

// How well an image from somewhere in the place would be located in its map,
// before anybody stands there.

#include <Eigen/Core>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

struct ViewpointPrediction {
  double matches = 0.0;  // points of the map that the image would likely show again
  // One sigma, in pixels, of where the pose found from them would put things at
  // the image's worst corner; infinite where no pose would be found.
  double error_px = 0.0;

  friend bool operator==(const ViewpointPrediction&, const ViewpointPrediction&) = default;
};

enum class ViewpointQuality { kGood, kFair, kPoor, kNone };
ViewpointQuality QualityOf(const ViewpointPrediction& prediction);

// A point counts as visible where it falls into the image, is seen from a
// direction not far from those it was trained from, and neither much nearer nor
// farther. How many of the visible ones are really found again is measured on the
// keyframes themselves, as is the noise of a sight. The pose's covariance is the
// inverse of the information of those sights. Walls that hide points are known
// only through the directions that points were seen from.
class ViewpointPredictor {
 public:
  // Copies what it needs; large maps are thinned out evenly.
  explicit ViewpointPredictor(const vision::SceneDatabase& database);

  ViewpointPrediction Predict(const geometry::Rigid3& camera_from_map) const;

  // Median distance from keyframes to what they see, map units; 0 without any.
  double median_depth() const { return median_depth_; }
  // Standard deviation of a sight along one axis.
  double noise_px() const { return noise_px_; }

 private:
  struct Point {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
    double min_cosine = 1.0;  // of the angle at the normal within which it is recognised
    double nearest = 0.0;     // distances between which it is recognised
    double farthest = 0.0;
  };

  void FillVisible(const geometry::Rigid3& camera_from_map, std::vector<uint32_t>& visible) const;
  void MeasureKeyframes(const vision::SceneDatabase& database, size_t stride);

  geometry::CameraModel camera_;
  std::vector<Point> points_;
  double points_each_ = 1.0;  // of the map that one of points_ stands for
  double found_share_ = 1.0;  // of visible points
  double noise_px_ = 1.0;
  double median_depth_ = 0.0;
};

}  // namespace lararium::train
