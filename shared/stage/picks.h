#pragma once

// Ties the stage to a place by points picked in training images. The picks
// outlive the map: after training again the same picks give the same stage.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"

namespace lararium::stage {

// A point of the place as it is seen in one training image.
struct Pick {
  int64_t frame_index = -1;  // in the video or folder
  std::string frame;         // name of the image; empty: the index alone decides
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // raw (distorted)
  uint32_t session = 0;                             // the recording that the frame is of
};

// Whether a pick was made in this keyframe.
bool LiesIn(const Pick& pick, const vision::Keyframe& keyframe);

// One point of the place. With picks in two or more keyframes it is
// triangulated. With one it is where the pick's ray meets the plane through the
// map points that are seen around it: good on walls and floors.
struct Anchor {
  std::string name;
  std::vector<Pick> picks;
};

struct StagePicks {
  Anchor origin;   // the stage's origin
  Anchor forward;  // the stage's -Z axis points from origin to here
  // A third point of the floor, off that line. +Y is the normal of the plane
  // through all three, on the side where the cameras are.
  Anchor floor;
  // length_m metres lie between these two; without picks they stand for origin
  // and forward.
  Anchor length_from;
  Anchor length_to;
  double length_m = 1.0;
};

// How well one anchor is known.
struct AnchorReport {
  std::string name;
  int picks = 0;          // that were used: in keyframes of this map
  double error_px = 0.0;  // root mean square reprojection error
  double angle = 0.0;     // widest angle between the picks' rays; 0 of a single pick
  Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
  std::vector<std::string> left_out;  // frames of picks that are no keyframes of this map
};

// Where the anchor lies in the map. Errors name it, and what to pick instead.
Result<AnchorReport> SolveAnchor(const Anchor& anchor, const vision::SceneDatabase& database);

// Standard deviation of the anchor's point, were every pick off by one pixel (first order);
// map units. Infinite where it could then not be located any more. The anchor has to be one that
// SolveAnchor() locates.
double AnchorSpread(const Anchor& anchor, const vision::SceneDatabase& database);

struct StageSolution {
  geometry::Similarity3 map_from_stage;
  std::vector<AnchorReport> anchors;
  // Standard deviation of the known length relative to itself, were every pick
  // off by one pixel (first order, through the whole solution).
  double length_spread = 0.0;
  // The known length as the stage's metres have it: another one than the picks'
  // length_m only where the scale was given.
  double measured_length_m = 0.0;
};

// map_units_per_metre: the scale, where it is known from elsewhere; the picks'
// known length is only measured then. Errors name the anchor and what to pick
// instead: no pick in a keyframe of this map (and in which frames they lie), rays
// too parallel, points on a line or in one place.
Result<StageSolution> SolveStage(const StagePicks& picks,
                                 const vision::SceneDatabase& database,
                                 std::optional<double> map_units_per_metre = std::nullopt);

}  // namespace lararium::stage
