#include "shared/show/camera_motion.h"

namespace lararium::show {

std::optional<CameraMotion> CameraMotionTracker::Update(int64_t frame,
                                                        const geometry::Rigid3& camera_from_stage) {
  const int64_t since = now_ ? frame - now_->frame : -1;
  if (since != 0) {
    motion_.reset();
    if (since > 0 && since <= kLongest) {
      motion_ = CameraMotion{now_->camera_from_stage, since};
    }
  }
  now_ = Seen{frame, camera_from_stage};
  return motion_;
}

}  // namespace lararium::show
