#include "shared/human/gaze.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/core/units.h"
#include "shared/human/turns.h"

namespace lararium::human {
namespace {
constexpr glm::vec3 kGazeForward(0.0f, 0.0f, -1.0f);

// Returns yaw (to the left) and pitch (upwards) of a direction.
glm::vec2 Angles(const glm::vec3& direction) {
  return {std::atan2(-direction.x, -direction.z),
          std::atan2(direction.y, std::hypot(direction.x, direction.z))};
}

glm::vec3 AlongAngles(const glm::vec2& angles) {
  return TurnY(angles.x) * (TurnX(angles.y) * kGazeForward);
}

float AngleBetween(const glm::vec3& a, const glm::vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Computes one tick of one person's gaze.
class Looker {
 public:
  Looker(
      const GazeModel& model, const glm::vec3& position, float heading, float seconds, Gaze& state)
      : eyes_(position + TurnY(heading) * model.eyes),
        heading_(heading),
        seconds_(seconds),
        state_(state) {}

  void Start(uint64_t seed) {
    state_.started = true;
    state_.random = seed * 0x9e3779b97f4a7c15ull + 1;
    state_.next_blink = Uniform(0.5f, 4.0f);
    state_.aversion_left = -Uniform(2.0f, 4.0f);
    state_.fixation = eyes_ + 3.0f * (TurnY(heading_) * kGazeForward);
  }

  void Update() {
    ChooseAttention();
    const glm::vec3 aim = Aim();
    MoveEyes(aim);
    MoveHead();
    Blink();
  }

 private:
  float Uniform(float low, float high) {
    uint64_t x = (state_.random += 0x9e3779b97f4a7c15ull);  // SplitMix64
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    x ^= x >> 31;
    return low + (high - low) * static_cast<float>(x >> 40) * 0x1p-24f;
  }
  float Exponential(float mean) { return -mean * std::log(1.0f - Uniform(0.0f, 0.999f)); }

  glm::vec2 BodyAngles(const glm::vec3& point) const {
    return Angles(TurnY(-heading_) * (point - eyes_));
  }

  // A target directly behind is ignored, because a person turns the body to look there.
  void ChooseAttention() {
    const float yaw = std::abs(BodyAngles(state_.target).x);
    const bool near = glm::distance(state_.target, eyes_) < 0.1f;
    attends_ =
        state_.kind != GazeKind::kNothing && !near && yaw < (state_.weight > 0.5f ? 2.6f : 2.35f);
    const float goal = attends_ ? 1.0f : 0.0f;
    state_.weight += Approach(seconds_, 0.25f) * (goal - state_.weight);
  }

  glm::vec3 Aim() {
    Wander();
    const glm::vec2 shift = state_.wander + Aversion();
    if (!attends_) {
      return eyes_ + 3.0f * (TurnY(heading_) * AlongAngles(shift));
    }
    const glm::vec3 way = state_.target - eyes_;
    const glm::vec2 angles = Angles(way) + shift;
    return eyes_ + glm::length(way) * AlongAngles(angles);
  }

  // The eyes never rest: the wandering covers about half a degree on a target, and wide angles
  // without one.
  void Wander() {
    state_.wander_left -= seconds_;
    if (state_.wander_left > 0.0f) {
      return;
    }
    const float wide = attends_ ? 0.7f * kRadiansPerDegreeF : 14.0f * kRadiansPerDegreeF;
    const float down = attends_ ? 0.0f : -6.0f * kRadiansPerDegreeF;
    state_.wander = {Uniform(-wide, wide), down + Uniform(-0.5f * wide, 0.5f * wide)};
    state_.wander_left = attends_ ? Uniform(0.4f, 1.6f) : Uniform(0.8f, 3.5f);
  }

  // Eye contact lasts 3.3 s on average (Binetti et al., R. Soc. Open Sci. 3, 2016);
  // speakers look away sooner (Kendon, Acta Psychologica 26, 1967).
  glm::vec2 Aversion() {
    if (state_.kind != GazeKind::kPerson || !attends_) {
      state_.aversion_left = -2.0f;
      return glm::vec2(0.0f);
    }
    const float before = state_.aversion_left;
    state_.aversion_left = before > 0.0f ? before - seconds_ : before + seconds_;
    if (before > 0.0f && state_.aversion_left <= 0.0f) {
      state_.aversion_left = -(state_.speaking ? Uniform(1.4f, 2.8f) : Uniform(2.6f, 4.0f));
    } else if (before <= 0.0f && state_.aversion_left >= 0.0f) {
      state_.aversion_left = Uniform(0.6f, 1.6f);
      const float side = Uniform(0.0f, 1.0f) < 0.5f ? -1.0f : 1.0f;
      state_.aversion = {side * Uniform(6.0f, 16.0f) * kRadiansPerDegreeF,
                         Uniform(-9.0f, 3.0f) * kRadiansPerDegreeF};
    }
    return state_.aversion_left > 0.0f ? state_.aversion : glm::vec2(0.0f);
  }

  void MoveEyes(const glm::vec3& aim) {
    if (state_.saccade_duration > 0.0f) {
      ContinueSaccade(aim);
      return;
    }
    state_.latency -= seconds_;
    const float error = AngleBetween(state_.fixation - eyes_, aim - eyes_);
    constexpr float kSaccade = 0.35f * kRadiansPerDegreeF;
    if (error > kSaccade && state_.latency <= 0.0f && !Follows(error)) {
      StartSaccade(error);
      return;
    }
    // Smooth pursuit at up to 40 degrees a second.
    const float most = 40.0f * kRadiansPerDegreeF * seconds_;
    const float share = error > 1e-6f ? std::min(Approach(seconds_, 0.06f), most / error) : 1.0f;
    state_.fixation = glm::mix(state_.fixation, aim, share);
  }

  // True if the eyes can follow a slowly drifting target without a saccade.
  bool Follows(float error) const {
    return error < 1.0f * kRadiansPerDegreeF && state_.wander_left > 0.2f && attends_ &&
           state_.latency > -0.05f;
  }

  // Duration from the main sequence: 2.2 ms for each degree plus 21 ms (Carpenter, Movements of the
  // Eyes, 1988; Bahill, Clark & Stark, Math. Biosci. 24, 1975).
  void StartSaccade(float amplitude) {
    state_.saccade_from = state_.fixation;
    state_.saccade_time = 0.0f;
    state_.saccade_duration = 0.021f + 0.0022f * amplitude / kRadiansPerDegreeF;
    // Lids close with most gaze shifts beyond 33 degrees (Evinger et al., 1994).
    const float chance = glm::smoothstep(15.0f, 40.0f, amplitude / kRadiansPerDegreeF);
    if (state_.blink_time < 0.0f && Uniform(0.0f, 1.0f) < 0.9f * chance) {
      state_.blink_time = 0.0f;
    }
  }

  void ContinueSaccade(const glm::vec3& aim) {
    state_.saccade_time += seconds_;
    const float t = std::min(state_.saccade_time / state_.saccade_duration, 1.0f);
    const float way = t * t * t * (10.0f + t * (6.0f * t - 15.0f));
    const glm::vec3 from = state_.saccade_from - eyes_, to = aim - eyes_;
    const glm::vec3 direction =
        Share(Arc(Direction(from, kGazeForward), Direction(to, kGazeForward)), way) *
        Direction(from, kGazeForward);
    state_.fixation = eyes_ + glm::mix(glm::length(from), glm::length(to), way) * direction;
    if (t >= 1.0f) {
      state_.saccade_duration = 0.0f;
      state_.latency = Uniform(0.12f, 0.25f);
    }
  }

  // The head takes the angle beyond the comfortable range of the eyes (Freedman & Sparks, J.
  // Neurophysiol. 77, 1997: it hardly moves below 15 to 20 degrees), and the trunk takes a part of
  // the angle beyond 40 degrees.
  void MoveHead() {
    const glm::vec2 gaze = attends_ ? BodyAngles(state_.fixation) : glm::vec2(0.0f);
    const auto beyond = [](float angle, float range) {
      return std::copysign(std::max(std::abs(angle) - range, 0.0f), angle);
    };
    const float torso = std::clamp(0.45f * beyond(gaze.x, 40.0f * kRadiansPerDegreeF),
                                   -GazeLimits::kTorsoYaw, GazeLimits::kTorsoYaw);
    const float yaw = std::clamp(beyond(gaze.x, 12.0f * kRadiansPerDegreeF) - torso,
                                 -GazeLimits::kHeadYaw, GazeLimits::kHeadYaw);
    const float pitch = std::clamp(0.75f * beyond(gaze.y, 6.0f * kRadiansPerDegreeF),
                                   -GazeLimits::kHeadDown, GazeLimits::kHeadUp);
    Spring(yaw, 10.0f, state_.head.x, state_.head_rate.x);
    Spring(pitch, 9.0f, state_.head.y, state_.head_rate.y);
    Spring(torso, 4.5f, state_.torso, state_.torso_rate);
  }

  // A critically damped spring; exact for a constant goal.
  void Spring(float goal, float frequency, float& value, float& rate) const {
    const float offset = value - goal;
    const float decay = std::exp(-frequency * seconds_);
    const float drive = (rate + frequency * offset) * seconds_;
    value = goal + (offset + drive) * decay;
    rate = (rate - frequency * drive) * decay;
  }

  // 17 blinks a minute at rest, 26 in conversation (Bentivoglio et al., Movement
  // Disorders 12, 1997); lids close within 0.1 s and open within 0.2 s.
  void Blink() {
    constexpr float kClosing = 0.09f, kClosed = 0.03f, kOpening = 0.20f;
    state_.next_blink -= seconds_;
    if (state_.next_blink <= 0.0f && state_.blink_time < 0.0f) {
      state_.blink_time = 0.0f;
    }
    float closed = 0.0f;
    if (state_.blink_time >= 0.0f) {
      const float t = state_.blink_time;
      closed = glm::smoothstep(0.0f, kClosing, t) *
               (1.0f - glm::smoothstep(kClosing + kClosed, kClosing + kClosed + kOpening, t));
      state_.blink_time += seconds_;
      if (t > kClosing + kClosed + kOpening) {
        state_.blink_time = -1.0f;
        const float mean = state_.speaking ? 60.0f / 26.0f : 60.0f / 17.0f;
        state_.next_blink = 0.7f + Exponential(mean - 1.0f);
      }
    }
    // The upper lids follow the eyes down.
    const float down = state_.head.y - BodyAngles(state_.fixation).y;
    const float lowered = 0.4f * glm::smoothstep(0.05f, GazeLimits::kEyeDown, down);
    state_.lids = std::max(closed, lowered);
  }

  glm::vec3 eyes_;
  float heading_;
  float seconds_;
  Gaze& state_;
  bool attends_ = false;
};

// Limits the rotation of the head against the chest to the range of a neck.
glm::quat WithinNeck(const glm::quat& chest_from_head) {
  const glm::vec2 angles = Angles(chest_from_head * kGazeForward);
  const float yaw = std::clamp(angles.x, -1.25f, 1.25f);
  const float pitch = std::clamp(angles.y, -0.80f, 0.70f);
  const glm::quat level = TurnX(-angles.y) * TurnY(-angles.x) * chest_from_head;
  return TurnY(yaw) * TurnX(pitch) * level;
}

class GazePose {
 public:
  GazePose(const GazeModel& model, const Skeleton& skeleton, std::span<JointTransform> pose)
      : body_(model.body), skeleton_(skeleton), pose_(pose) {}

  void TurnTorso(float yaw) {
    const float share = 1.0f / static_cast<float>(std::max<size_t>(body_.spine.size(), 1));
    for (const JointIndex joint : body_.spine) {
      TurnInActor(skeleton_, joint, TurnY(share * yaw), pose_);
    }
  }

  void TurnHead(const Gaze& state) {
    if (body_.neck.empty()) {
      return;
    }
    constexpr float kKept = 0.35f;  // share of the head motion of clip or gait that remains
    const glm::quat before = Turned(body_.head);
    const glm::quat looking = TurnY(state.torso + state.head.x) * TurnX(state.head.y);
    const glm::quat chest = body_.chest() == kNoJoint ? kNoTurn : Turned(body_.chest());
    const glm::quat wanted = glm::slerp(before, looking * Share(before, kKept), state.weight);
    const glm::quat after = chest * WithinNeck(glm::conjugate(chest) * wanted);
    const glm::quat turn =
        Share(after * glm::conjugate(before), 1.0f / static_cast<float>(body_.neck.size()));
    for (const JointIndex joint : body_.neck) {
      TurnInActor(skeleton_, joint, turn, pose_);
    }
  }

  // Turns each eye to the point within the eye's limits.
  void TurnEyes(const glm::vec3& fixation) {
    const glm::quat head = body_.head == kNoJoint ? kNoTurn : Turned(body_.head);
    for (const JointIndex eye : body_.eyes) {
      if (eye == kNoJoint) {
        continue;
      }
      const glm::vec3 at = ActorFromJoint(skeleton_, pose_, eye).position;
      const glm::vec2 angles = Angles(glm::conjugate(head) * (fixation - at));
      const glm::vec2 within(std::clamp(angles.x, -GazeLimits::kEyeYaw, GazeLimits::kEyeYaw),
                             std::clamp(angles.y, -GazeLimits::kEyeDown, GazeLimits::kEyeUp));
      const glm::quat turn = head * Arc(kGazeForward, AlongAngles(within));  // Listing's law
      SetActorRotation(skeleton_, eye, turn * RestRotation(eye), pose_);
    }
  }

 private:
  const glm::quat& RestRotation(JointIndex joint) const {
    return body_.rest[static_cast<size_t>(joint)].rotation;
  }
  // Returns the rotation of a joint from its rest pose, in actor axes.
  glm::quat Turned(JointIndex joint) const {
    return ActorFromJoint(skeleton_, pose_, joint).rotation * glm::conjugate(RestRotation(joint));
  }

  const BodyRig& body_;
  const Skeleton& skeleton_;
  std::span<JointTransform> pose_;
};

}  // namespace

GazeModel MakeGazeModel(const BodyRig& body) {
  GazeModel model;
  model.body = body;
  model.has_eyes = body.eyes[kRight] != kNoJoint && body.eyes[kLeft] != kNoJoint;
  const auto rest = [&](JointIndex joint) {
    return body.rest[static_cast<size_t>(joint)].position;
  };
  if (model.has_eyes) {
    model.eyes = 0.5f * (rest(body.eyes[kRight]) + rest(body.eyes[kLeft]));
  } else if (body.head != kNoJoint) {
    const float size = body.hip_height > 0.0f ? body.hip_height / 0.9f : 1.0f;
    model.eyes = rest(body.head) + size * glm::vec3(0.0f, 0.08f, -0.08f);
  }
  return model;
}

void UpdateGaze(const GazeModel& model,
                const glm::vec3& position,
                float heading,
                uint64_t seed,
                float seconds,
                Gaze& state) {
  Looker looker(model, position, heading, seconds, state);
  if (!state.started) {
    looker.Start(seed);
  }
  if (seconds > 0.0f) {
    looker.Update();
  }
}

Gaze Interpolate(const Gaze& previous, const Gaze& current, float alpha) {
  if (!previous.started) {
    return current;
  }
  Gaze mixed = current;
  mixed.fixation = glm::mix(previous.fixation, current.fixation, alpha);
  mixed.head = glm::mix(previous.head, current.head, alpha);
  mixed.torso = glm::mix(previous.torso, current.torso, alpha);
  mixed.lids = glm::mix(previous.lids, current.lids, alpha);
  mixed.weight = glm::mix(previous.weight, current.weight, alpha);
  return mixed;
}

void ApplyGaze(const GazeModel& model,
               const Skeleton& skeleton,
               const Gaze& state,
               const glm::vec3& position,
               float heading,
               std::span<JointTransform> pose) {
  if (!state.started) {
    return;
  }
  GazePose gaze(model, skeleton, pose);
  gaze.TurnTorso(state.torso);
  gaze.TurnHead(state);
  gaze.TurnEyes(TurnY(-heading) * (state.fixation - position));
}

}  // namespace lararium::human
