#include "shared/show/camera_motion.h"

namespace lararium::show {
namespace {

bool Leaps(const geometry::Rigid3& before, const geometry::Rigid3& now, int64_t frames) {
  const geometry::Rigid3 apart = now * before.Inverse();
  const double turned = apart.rotation.angularDistance(Eigen::Quaterniond::Identity());
  const double count = static_cast<double>(frames);
  return apart.translation.norm() > CameraMotionTracker::kFarthest * count ||
         turned > CameraMotionTracker::kWidest * count;
}

}  // namespace

geometry::Rigid3 Predict(const CameraMotion& motion,
                         const geometry::Rigid3& camera_from_stage,
                         double frames) {
  const geometry::Rigid3 moved = camera_from_stage * motion.before_from_stage.Inverse();
  const double share = frames / static_cast<double>(motion.frames);
  const Eigen::AngleAxisd turned(moved.rotation);
  const geometry::Rigid3 ahead = {
      .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(share * turned.angle(), turned.axis())),
      .translation = share * moved.translation};
  return ahead * camera_from_stage;
}

std::optional<CameraMotion> CameraMotionTracker::Update(int64_t frame,
                                                        const geometry::Rigid3& camera_from_stage) {
  const int64_t since = now_ ? frame - now_->frame : -1;
  if (since != 0) {
    motion_.reset();
    if (since > 0 && since <= kLongest &&
        !Leaps(now_->camera_from_stage, camera_from_stage, since)) {
      motion_ = CameraMotion{now_->camera_from_stage, since};
    }
  }
  now_ = Seen{frame, camera_from_stage};
  return motion_;
}

}  // namespace lararium::show
