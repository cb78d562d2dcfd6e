#pragma once

// How the camera moved from one frame to the next: what its own motion smears.

#include <cstdint>
#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::show {

struct CameraMotion {
  geometry::Rigid3 before_from_stage;  // the camera's pose some frames ago
  int64_t frames = 1;                  // since
};

// Where the camera will be so many frames later if it goes on like this.
geometry::Rigid3 Predict(const CameraMotion& motion,
                         const geometry::Rigid3& camera_from_stage,
                         double frames);

// Follows the poses of successive frames at one place.
class CameraMotionTracker {
 public:
  // What lies further back says nothing about now.
  static constexpr int64_t kLongest = 4;  // frames
  // No head goes faster from one frame to the next: it was found elsewhere, as where a
  // recording begins again.
  static constexpr double kFarthest = 0.25;  // metres a frame
  static constexpr double kWidest = 0.44;    // radians a frame

  // The motion up to this frame; none where no frame shortly before had a pose, none over
  // a leap. The same frame once more has the same motion, whatever its pose is now.
  std::optional<CameraMotion> Update(int64_t frame, const geometry::Rigid3& camera_from_stage);

  // After a gap without poses, at another place.
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
