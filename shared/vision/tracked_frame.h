#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/frame.h"
#include "shared/geometry/transform.h"

namespace lararium::vision {

enum class TrackState {
  kSearching,  // no pose yet
  kTracking,   // this frame has a pose
  kLost,       // had a pose before, this frame has none
};

// Why a frame has no pose.
enum class TrackReason {
  kNone,             // it has one
  kTooDark,          // hardly any light
  kTooFewFeatures,   // covered lens, blur, a blank wall
  kTooFewMatches,    // sees another place, or another light
  kNoConsistentPose  // matches do not agree on one pose
};

std::string_view Name(TrackState state);
std::string_view Name(TrackReason reason);

// An image with its pose. The image shown is the image that was tracked.
struct TrackedFrame {
  geometry::Frame frame;
  geometry::CameraModel camera;
  std::optional<geometry::Rigid3> camera_from_map;  // set exactly when tracking
  TrackState state = TrackState::kSearching;
  TrackReason reason = TrackReason::kNone;
  float confidence = 0.0f;  // 0..1
  int features = 0;
  int matches = 0;
  int inliers = 0;
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};  // image over map reference, linear R, G, B
};

// Gives frames their poses: the SIFT tracker, recorded poses, a headset.
class PoseSource {
 public:
  virtual ~PoseSource() = default;
  virtual TrackedFrame Track(const geometry::Frame& frame) = 0;
};

}  // namespace lararium::vision
