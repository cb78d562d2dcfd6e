#pragma once

// Analyses after training how well the place was filmed, and advises what to film next.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "editor/train/capture_advice.h"
#include "editor/train/trainer.h"
#include "editor/train/viewpoint_predictor.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// Axes of the view of the place from above, in map coordinates. Up is the mean up direction of the
// cameras; the top of the plan is their mean viewing direction.
struct PlanView {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();

  Eigen::Vector2d operator()(const Eigen::Vector3d& point) const {
    return {right.dot(point), ahead.dot(point)};
  }
};

struct Histogram {
  std::vector<std::string> labels;
  std::vector<size_t> counts;  // Parallel to labels.
};

// Consecutive frames with the same weakness.
struct WeakFrames {
  size_t first = 0;  // First and last index into TrainReport::frame_reports.
  size_t last = 0;
  WeakReason reason = WeakReason::kNotLocated;
  bool located = false;
};

// A square of the floor where a visitor may stand. The prediction is made at the height of the
// nearest keyframes. For each of them it is the worst over the keyframe's viewing direction and 30
// degrees to either side; the best keyframe counts.
struct StandingPlace {
  Eigen::Vector2d center;  // Plan coordinates.
  ViewpointPrediction prediction;
};

struct CaptureAnalysis {
  PlanView plan;
  Histogram reprojection;             // Observations by reprojection error, pixels.
  Histogram track_lengths;            // Points by number of observing images.
  Histogram parallax;                 // Points by the widest angle between two observations.
  std::vector<float> point_parallax;  // [points]: Widest angle, radians.
  double cell = 0.0;                  // Side of a standing place, map units.
  std::vector<StandingPlace> places;  // Cover the surroundings of the camera path.
  double noise_px = 0.0;
  double median_depth = 0.0;
  std::vector<WeakFrames> weak;
  std::vector<CaptureAdvice> advice;  // The most urgent first; never empty.
};

// metres_per_unit is the scale of the map, if the stage has fixed it. Advice then gives distances
// in metres.
CaptureAnalysis AnalyseCapture(const TrainReport& report,
                               const vision::SceneDatabase& database,
                               std::optional<double> metres_per_unit);

}  // namespace lararium::train
