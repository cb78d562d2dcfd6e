#include "shared/show/stage_anchor.h"

#include <algorithm>
#include <cmath>

namespace lararium::show {
namespace {

// Time constant of the smoothing in seconds: after this time, 1/e of a difference is left.
constexpr double kAnchorSettling = 0.4;
// Larger differences are real motions of the stage, not errors of measurement.
constexpr double kLeapMetres = 0.15;
constexpr double kLeapRadians = 0.09;
constexpr int kLeapsBelieved = 3;
constexpr double kAnchorFade = 1.0;  // seconds in which people fade out

}  // namespace

void StageAnchor::Observe(const geometry::Rigid3& room_from_stage, double seconds) {
  const double passed = std::max(seconds - observed_, 0.0);
  observed_ = seconds;
  if (!room_from_stage_) {
    room_from_stage_ = room_from_stage;
    return;
  }
  geometry::Rigid3& held = *room_from_stage_;
  const bool leaps = (room_from_stage.translation - held.translation).norm() > kLeapMetres ||
                     held.rotation.angularDistance(room_from_stage.rotation) > kLeapRadians;
  leaps_ = leaps ? leaps_ + 1 : 0;
  if (leaps && leaps_ < kLeapsBelieved) {
    return;
  }
  const double share = leaps ? 1.0 : 1.0 - std::exp(-passed / kAnchorSettling);
  held.rotation = held.rotation.slerp(share, room_from_stage.rotation);
  held.translation += share * (room_from_stage.translation - held.translation);
  leaps_ = leaps ? 0 : leaps_;
}

float StageAnchor::Opacity(double seconds) const {
  if (!room_from_stage_) {
    return 0.0f;
  }
  const double since = seconds - observed_;
  return static_cast<float>(std::clamp(1.0 - (since - held_) / kAnchorFade, 0.0, 1.0));
}

}  // namespace lararium::show
