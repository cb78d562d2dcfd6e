#pragma once

// Registers the stage in a place from points picked in training images. Picks outlive the map:
// after another training the same picks give the same stage.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"

namespace lararium::stage {

// One point of the place, picked in one training image.
struct Pick {
  int64_t frame_index = -1;                         // Index in the video or folder.
  std::string frame;                                // Name of the image; empty: not compared.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // Raw (distorted) pixel.
  uint32_t session = 0;                             // Recording of the frame.
};

// Whether a pick was made in this keyframe.
bool LiesIn(const Pick& pick, const vision::Keyframe& keyframe);

// One point of the place. Picks in two or more keyframes are triangulated. A single pick gives the
// point where its ray meets the plane through the surrounding map points, which works on walls and
// floors.
struct Anchor {
  std::string name;
  std::vector<Pick> picks;
};

struct StagePicks {
  Anchor origin;   // The origin of the stage.
  Anchor forward;  // The stage's -Z axis points from `origin` to here.
  // A third point of the floor, off that line. +Y is the normal of the plane through all three
  // points, on the side of the cameras.
  Anchor floor;
  // The distance between these two is length_m. Without picks they default to `origin` and
  // `forward`.
  Anchor length_from;
  Anchor length_to;
  double length_m = 1.0;
};

// Position and accuracy of one anchor.
struct AnchorReport {
  std::string name;
  int picks = 0;          // Picks that were used because they lie in keyframes of this map.
  double error_px = 0.0;  // Root mean square reprojection error, pixels.
  double angle = 0.0;     // Widest angle between the picks' rays, radians; 0 for a single pick.
  Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
  std::vector<std::string> left_out;  // Frames of picks that are not keyframes of this map.
};

// Locates the anchor in the map. Errors name the anchor and what to pick instead.
Result<AnchorReport> SolveAnchor(const Anchor& anchor, const vision::SceneDatabase& database);

// Locates the anchor in the map. Errors name the anchor and what to pick instead.
// Standard deviation of the anchor's point, in map units, if every pick coordinate has a standard
// deviation of one pixel (first order). Infinite if such an error makes the point impossible to
// locate. Requires that SolveAnchor() succeeds.
double AnchorSpread(const Anchor& anchor, const vision::SceneDatabase& database);

struct StageSolution {
  geometry::Similarity3 map_from_stage;
  std::vector<AnchorReport> anchors;
  // Relative standard deviation of the known length, if every pick coordinate has a standard
  // deviation of one pixel (first order, through the whole solution).
  double length_spread = 0.0;
  // The known length in metres of the stage. Differs from StagePicks::length_m only if the scale
  // was given.
  double measured_length_m = 0.0;
};

// map_units_per_metre: the scale, if it is known from elsewhere; the known length is then only
// measured. Errors name the anchor and what to pick instead: no pick in a keyframe of this map
// (with the frames of the picks), rays too parallel, points on one line or in one place.
Result<StageSolution> SolveStage(const StagePicks& picks,
                                 const vision::SceneDatabase& database,
                                 std::optional<double> map_units_per_metre = std::nullopt);

}  // namespace lararium::stage
