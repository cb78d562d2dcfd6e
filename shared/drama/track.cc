#include "shared/drama/track.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace lararium::drama {
namespace {

constexpr double kTurnSeconds =
    0.5;  // Duration of the turn from one segment's heading to the next.

double Fraction(double time, double length) {
  return length > 0.0 ? std::clamp(time / length, 0.0, 1.0) : 1.0;
}

}  // namespace

void ApplyTrack(std::span<const TrackSegment> segments, double time, stage::ActorState& state) {
  const auto next =
      std::upper_bound(segments.begin(), segments.end(), time,
                       [](double t, const TrackSegment& segment) { return t < segment.begin; });
  state.visible = next != segments.begin();
  if (!state.visible) {
    state.animation_state.locomotion.placed = false;
    return;
  }
  const TrackSegment& now = *(next - 1);
  const TrackSegment* before = next - 1 == segments.begin() ? nullptr : &*(next - 2);
  const double elapsed = time - now.begin;

  const double way = Eased(now.ease, Fraction(elapsed, now.length));
  state.position = glm::mix(now.from, now.to, static_cast<float>(way));
  state.heading = now.heading;
  human::Animation& animation = state.animation_state.animation;
  animation = human::Animation();
  animation.clip = now.clip;
  animation.rate = now.rate;
  animation.clip_time = elapsed * now.rate;
  if (before != nullptr) {
    const float turn =
        std::remainder(now.heading - before->heading, 2.0f * std::numbers::pi_v<float>);
    const auto turned = static_cast<float>(Fraction(elapsed, kTurnSeconds));
    state.heading = now.heading - (1.0f - turned) * turn;
    animation.weight = static_cast<float>(Fraction(elapsed, now.fade));
    if (animation.weight < 1.0f) {
      animation.previous_clip = before->clip;
      animation.previous_rate = before->rate;
      animation.previous_time = (time - before->begin) * before->rate;
    }
  }
}

}  // namespace lararium::drama
