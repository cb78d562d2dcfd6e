#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/frame.h"
#include "shared/geometry/transform.h"
#include "shared/vision/occluders.h"

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
  uint32_t map = 0;  // of the tracker's maps: the one that the pose lies in
  TrackState state = TrackState::kSearching;
  TrackReason reason = TrackReason::kNone;
  bool followed = false;  // from the frame before; otherwise found without a prior
  // The probability that the pose puts what is visible within 1 pixel of its
  // place, on average over the image. 0 without a pose.
  float confidence = 0.0f;
  // Of (w, v) in the pose (exp(w) R, exp(w) t + v); map units.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  int features = 0;
  int matches = 0;
  int inliers = 0;
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};  // image over map reference, linear R, G, B
  // Share of the time between frames for which the shutter is open, as fast motion has shown
  // it; none before that.
  std::optional<float> shutter = std::nullopt;
};

// A map point that was seen where the pose puts it.
struct SeenPoint {
  uint32_t point = 0;
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // raw
};

// Gives frames their poses: the SIFT tracker, or what smooths its poses.
class PoseSource {
 public:
  virtual ~PoseSource() = default;
  virtual TrackedFrame Track(const geometry::Frame& frame) = 0;
  // The next frame is found without what is known of those before. From any thread. A source
  // that follows nothing has no use for it.
  virtual void FindAnew() {}
  // The points that the last pose stands on, of TrackedFrame::map; nothing without a pose, or
  // from a source that looks for no points.
  virtual void Seen(std::vector<SeenPoint>& seen) const { seen.clear(); }
  // What hides the points of a map from now on, in place of what did before. Between
  // frames. A source that looks for no points has no use for it.
  virtual void SetOccluders([[maybe_unused]] uint32_t map,
                            [[maybe_unused]] std::span<const OccluderMesh> meshes) {}
};

}  // namespace lararium::vision
