#pragma once

// The camera's motion between frames, which causes motion blur.

#include <cstdint>
#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::show {

struct CameraMotion {
  geometry::Rigid3 before_from_stage;  // The camera's pose `frames` frames ago.
  int64_t frames = 1;                  // Frames since that pose.
};

// Extrapolates the camera's pose by a number of frames at constant velocity.
geometry::Rigid3 Predict(const CameraMotion& motion,
                         const geometry::Rigid3& camera_from_stage,
                         double frames);

// Follows the poses of successive frames at one place.
class CameraMotionTracker {
 public:
  // Older poses do not tell the present motion.
  static constexpr int64_t kLongest = 4;  // frames
  // Faster motion is not a head's: the pose jumped, for example because a recording started again.
  static constexpr double kFarthest = 0.25;  // metres a frame
  static constexpr double kWidest = 0.44;    // radians a frame

  // The motion up to this frame; nullopt if no recent frame had a pose, or after a jump. Another
  // call for the same frame returns the same motion, even for another pose.
  std::optional<CameraMotion> Update(int64_t frame, const geometry::Rigid3& camera_from_stage);

  // Call after a gap without poses, or at another place.
  void Reset() { now_.reset(); }

 private:
  struct Seen {
    int64_t frame = 0;
    geometry::Rigid3 camera_from_stage;
  };
  std::optional<Seen> now_;
  std::optional<CameraMotion> motion_;
};

}  // namespace lararium::show
