#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/frame.h"
#include "shared/geometry/transform.h"
#include "shared/vision/occluders.h"
#include "shared/vision/rolling_shutter.h"

namespace lararium::vision {

enum class TrackState {
  kSearching,  // no pose yet
  kTracking,   // this frame has a pose
  kLost,       // had a pose before, this frame has none
};

// Why a frame has no pose.
enum class TrackReason {
  kNone,              // the frame has a pose
  kTooDark,           // hardly any light
  kTooFewFeatures,    // covered lens, blur, a blank wall
  kTooFewMatches,     // another place, or another light
  kNoConsistentPose,  // the matches do not agree on one pose
  kAmbiguous          // several parts of the place look like the image
};

std::string_view Name(TrackState state);
std::string_view Name(TrackReason reason);

// An image with its pose. The image shown is the image that was tracked.
struct TrackedFrame {
  geometry::Frame frame;
  geometry::CameraModel camera;  // The given one, or the estimate for this image.
  std::optional<geometry::Rigid3> camera_from_map;  // Set if and only if state is kTracking.
  uint32_t map = 0;  // Index of the map that the pose refers to, among the tracker's maps.
  TrackState state = TrackState::kSearching;
  TrackReason reason = TrackReason::kNone;
  // The pose was tracked from the frame before. Otherwise it was found without a prior.
  bool followed = false;
  // Probability that the pose's registration error, root mean square over the image, is below
  // 1 pixel; see PoseConfidence. 0 without a pose.
  float confidence = 0.0f;
  // Covariance of (w, v) in the pose (exp(w) R, exp(w) t + v); radians and map units.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::optional<RollingShutter> rolling_shutter = std::nullopt;  // None if the motion is unknown.
  int features = 0;
  int matches = 0;
  int inliers = 0;
  // Brightness of the image over the map's photometric reference, linear R, G, B.
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};
  // Share of the frame time for which the shutter is open, estimated from the blur of fast motion;
  // none until enough fast motion was observed.
  std::optional<float> shutter = std::nullopt;
  // What stands before the surfaces of the map (foreground/foreground_mask.h), as a small CV_32FC4
  // image that covers the frame. Its value (b, g, r, offset), interpolated at a pixel of the frame
  // with the encoded colour (B, G, R), 0 to 1, gives the opacity of the foreground there:
  // b B + g G + r R + offset, clamped to 0..1. Empty if there is no foreground, or none is known.
  cv::Mat foreground = {};
};

// A map point that was found in the image at the position that the pose predicts.
struct SeenPoint {
  uint32_t point = 0;
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // raw pixel
};

// Assigns poses to frames. Implemented by the tracker and by the pose smoother around it.
class PoseSource {
 public:
  virtual ~PoseSource() = default;
  virtual TrackedFrame Track(const geometry::Frame& frame) = 0;
  // Makes the source locate the next frame without a prior. May be called from any thread. Does
  // nothing in a source that does not track from frame to frame.
  virtual void Relocalize() {}
  // Fills in the points of TrackedFrame::map that support the last pose. Empty without a pose, or
  // from a source that does not use map points.
  virtual void Seen(std::vector<SeenPoint>& seen) const { seen.clear(); }
  // Replaces the occluders of a map. Call it between frames only. Does nothing in a source that
  // does not use map points.
  virtual void SetOccluders([[maybe_unused]] uint32_t map,
                            [[maybe_unused]] std::span<const OccluderMesh> meshes) {}
};

}  // namespace lararium::vision
