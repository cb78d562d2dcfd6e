#pragma once

// What a finished training says about how the place was filmed, and what to film
// next.

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

// The place from above. Upwards is where cameras were held upright; the top of
// the plan is where they looked on average.
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
  std::vector<size_t> counts;  // of the same index
};

// A stretch of frames of one weakness.
struct WeakFrames {
  size_t first = 0;  // indices of TrainReport::frame_reports
  size_t last = 0;
  WeakReason reason = WeakReason::kNotLocated;
  bool located = false;
};

// A square of the floor where a visitor may stand, at the height of the nearest
// keyframe, looking where the keyframes near it looked, or up to 30 degrees to
// either side: the worst of these.
struct StandingPlace {
  Eigen::Vector2d center;  // plan
  ViewpointPrediction prediction;
};

struct CaptureAnalysis {
  PlanView plan;
  Histogram reprojection;             // observations by error, pixels
  Histogram track_lengths;            // points by number of images that saw them
  Histogram parallax;                 // points by the widest angle between two of their sights
  std::vector<float> point_parallax;  // [points], radians
  double cell = 0.0;                  // side of a standing place, map units
  std::vector<StandingPlace> places;  // around the camera path
  double noise_px = 0.0;
  double median_depth = 0.0;
  std::vector<WeakFrames> weak;
  std::vector<CaptureAdvice> advice;  // the most urgent first; never empty
};

// metres_per_unit: of the map, where the stage has fixed it; advice gives
// distances in metres then.
CaptureAnalysis AnalyseCapture(const TrainReport& report,
                               const vision::SceneDatabase& database,
                               std::optional<double> metres_per_unit);

}  // namespace lararium::train
