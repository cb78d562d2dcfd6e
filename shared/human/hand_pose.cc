#include "shared/human/hand_pose.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "shared/human/palm.h"
#include "shared/human/turns.h"

namespace lararium::human {
namespace {

constexpr std::array<std::string_view, kHandPoseCount> kNames = {
    "relaxed", "flat", "fist", "cylinder", "pinch", "point", "ladle", "bowl"};

// Flexion of a finger's joints from the knuckle outward, and spread at the knuckle, in degrees. For
// the thumb: flexion of its three joints, and opposition.
struct FingerPose {
  std::array<float, 3> flexion;
  float spread;
};
using HandAngles = std::array<FingerPose, BodyRig::kFingers>;

// Set by eye, within the ranges of healthy fingers (90, 100, 70 degrees).
constexpr std::array<HandAngles, kHandPoseCount> kPoses = {{
    {{{{4, 8, 12}, -10},
      {{18, 22, 14}, 3},
      {{22, 27, 17}, 0},
      {{26, 30, 18}, -3},
      {{28, 32, 18}, -5}}},
    {{{{-6, 0, 0}, -32}, {{2, 2, 2}, 4}, {{2, 2, 2}, 1}, {{2, 2, 2}, -2}, {{2, 2, 2}, -6}}},
    {{{{26, 42, 52}, -8},
      {{82, 95, 60}, 0},
      {{85, 98, 62}, 0},
      {{86, 98, 62}, -1},
      {{86, 96, 60}, -2}}},
    {{{{14, 14, 22}, 8},
      {{46, 50, 30}, 4},
      {{50, 52, 32}, 1},
      {{54, 54, 32}, -2},
      {{58, 54, 32}, -5}}},
    {{{{22, 16, 14}, 2},
      {{50, 46, 18}, 2},
      {{56, 50, 22}, 0},
      {{62, 60, 30}, -1},
      {{66, 62, 32}, -3}}},
    {{{{22, 36, 45}, -8},
      {{4, 4, 2}, 1},
      {{70, 92, 55}, 0},
      {{78, 95, 58}, -2},
      {{80, 95, 58}, -3}}},
    {{{{20, 18, 14}, 0},
      {{36, 34, 14}, 2},
      {{74, 84, 48}, 0},
      {{80, 88, 50}, -1},
      {{82, 88, 50}, -3}}},
    {{{{-4, 2, 6}, -14},
      {{16, 14, 8}, 8},
      {{18, 16, 9}, 2},
      {{20, 17, 9}, -5},
      {{22, 18, 9}, -11}}},
}};

// The mean of all poses weighted by their shares, degrees.
HandAngles Blend(const std::array<float, kHandPoseCount>& shares) {
  HandAngles sum = {};
  for (size_t pose = 0; pose < kPoses.size(); ++pose) {
    if (shares[pose] <= 0.0f) {
      continue;
    }
    for (size_t finger = 0; finger < sum.size(); ++finger) {
      for (size_t i = 0; i < 3; ++i) {
        sum[finger].flexion[i] += shares[pose] * kPoses[pose][finger].flexion[i];
      }
      sum[finger].spread += shares[pose] * kPoses[pose][finger].spread;
    }
  }
  return sum;
}

// Returns the flexion in radians. If a character has fewer joints, its last joint takes over a part
// of the flexion of the missing ones.
float FlexionOf(const FingerPose& finger, const HandModel::Joint& joint) {
  float flexion = finger.flexion[joint.segment];
  for (size_t i = joint.segment + 1u; joint.last && i < finger.flexion.size(); ++i) {
    flexion += 0.5f * finger.flexion[i];
  }
  return glm::radians(flexion);
}

class HandMeasurer {
 public:
  HandMeasurer(const Skeleton& skeleton, const BodyRig& body, int side)
      : skeleton_(skeleton), body_(body), palm_(FindPalm(body, side)), side_(side) {}

  std::vector<HandModel::Joint> Measure() const {
    std::vector<HandModel::Joint> joints;
    for (int finger = 0; finger < BodyRig::kFingers; ++finger) {
      MeasureFinger(finger, joints);
    }
    return joints;
  }

 private:
  const JointFrame& Rest(JointIndex joint) const { return body_.rest[static_cast<size_t>(joint)]; }

  // Direction to the finger's next joint or its end; `before` if it has neither.
  glm::vec3 Segment(JointIndex joint, const glm::vec3& before) const {
    for (size_t i = 0; i < skeleton_.size(); ++i) {
      if (skeleton_.parents[i] == joint) {
        return Direction(Rest(static_cast<JointIndex>(i)).position - Rest(joint).position, before);
      }
    }
    return before;
  }

  void MeasureFinger(int finger, std::vector<HandModel::Joint>& joints) const {
    const auto& chain =
        body_.fingers[static_cast<size_t>(side_)][static_cast<size_t>(finger)].joints;
    glm::vec3 before = palm_.along;
    if (finger == BodyRig::kThumb && chain[0] != kNoJoint) {
      before = Direction(
          Rest(chain[0]).position - Rest(body_.arms[static_cast<size_t>(side_)].wrist).position,
          palm_.along);
    }
    for (size_t segment = 0; segment < chain.size() && chain[segment] != kNoJoint; ++segment) {
      const glm::vec3 direction = Segment(chain[segment], before);
      HandModel::Joint joint;
      joint.joint = chain[segment];
      joint.finger = static_cast<uint8_t>(finger);
      joint.segment = static_cast<uint8_t>(segment);
      joint.last = segment + 1 == chain.size() || chain[segment + 1] == kNoJoint;
      SetAxes(direction, before, joint);
      joints.push_back(joint);
      before = direction;
    }
  }

  void SetAxes(const glm::vec3& direction, const glm::vec3& before, HandModel::Joint& joint) const {
    const glm::quat joint_from_actor = glm::conjugate(Rest(joint.joint).rotation);
    const glm::quat rest = skeleton_.rest[static_cast<size_t>(joint.joint)].rotation;
    glm::vec3 flexed = -palm_.back, spread = palm_.thumb;
    if (joint.finger == BodyRig::kThumb) {
      // Thumbs bend across the palm and oppose towards it.
      flexed = glm::normalize(-palm_.thumb - 0.25f * palm_.back);
      spread = glm::normalize(-palm_.back - 0.4f * palm_.thumb);
    }
    const glm::vec3 axis = Direction(glm::cross(direction, flexed), AnyAcross(direction));
    joint.flexion = joint_from_actor * axis;
    joint.spread =
        joint_from_actor * Direction(glm::cross(direction, spread), AnyAcross(direction));
    joint.straight = rest;
    if (joint.finger == BodyRig::kThumb) {
      return;
    }
    const glm::vec3 a = Direction(Across(before, axis), direction);
    const glm::vec3 b = Direction(Across(direction, axis), direction);
    const float bent = std::atan2(glm::dot(glm::cross(a, b), axis), glm::dot(a, b));
    const glm::quat flexed_at_rest = glm::angleAxis(bent, joint.flexion);
    joint.straight = rest * glm::conjugate(flexed_at_rest);
    if (joint.segment == 0) {
      // Fingers that are spread at rest are closed first.
      const float aside =
          std::atan2(glm::dot(direction, palm_.thumb), glm::dot(direction, palm_.along));
      joint.spread = flexed_at_rest * (joint_from_actor * glm::cross(palm_.along, palm_.thumb));
      joint.straight = joint.straight * glm::angleAxis(-aside, joint.spread);
    }
  }

  const Skeleton& skeleton_;
  const BodyRig& body_;
  Palm palm_;
  int side_;
};

}  // namespace

std::optional<HandPose> HandPoseNamed(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  return found == kNames.end() ? std::nullopt
                               : std::optional(static_cast<HandPose>(found - kNames.begin()));
}

std::string_view NameOf(HandPose pose) { return kNames[static_cast<size_t>(pose)]; }

void SetHandPose(HandState& hand, HandPose pose, float seconds) {
  hand.pose = pose;
  hand.change_per_second = seconds > 0.0f ? 1.0f / seconds : 1e6f;
}

void UpdateHand(HandState& hand, float seconds) {
  float& goal = hand.shares[static_cast<size_t>(hand.pose)];
  const float missing = 1.0f - goal;
  if (missing <= 0.0f) {
    return;
  }
  const float left = std::max(missing - seconds * hand.change_per_second, 0.0f) / missing;
  for (float& share : hand.shares) {
    share *= left;
  }
  goal = 1.0f - left * missing;
}

HandState Interpolate(const HandState& previous, const HandState& current, float alpha) {
  HandState mixed = current;
  for (size_t i = 0; i < mixed.shares.size(); ++i) {
    mixed.shares[i] = glm::mix(previous.shares[i], current.shares[i], alpha);
  }
  mixed.strength = glm::mix(previous.strength, current.strength, alpha);
  return mixed;
}

HandModel MakeHandModel(const Skeleton& skeleton, const BodyRig& body) {
  HandModel model;
  for (const int side : {kRight, kLeft}) {
    if (body.arms[static_cast<size_t>(side)].whole()) {
      model.joints[static_cast<size_t>(side)] = HandMeasurer(skeleton, body, side).Measure();
    }
  }
  return model;
}

void ApplyHand(const HandModel& model,
               const HandState& state,
               const IdleMotionSample& idle_motion,
               int side,
               std::span<JointTransform> pose) {
  if (state.strength <= 0.0f) {
    return;
  }
  const HandAngles angles = Blend(state.shares);
  for (const HandModel::Joint& joint : model.joints[static_cast<size_t>(side)]) {
    const FingerPose& finger = angles[joint.finger];
    const float small = idle_motion.fingers[static_cast<size_t>(side)][joint.finger];
    const float flexion = FlexionOf(finger, joint) + small;
    const float spread = joint.segment == 0 ? glm::radians(finger.spread) : 0.0f;
    const glm::quat turned = joint.straight * glm::angleAxis(spread, joint.spread) *
                             glm::angleAxis(flexion, joint.flexion);
    glm::quat& rotation = pose[static_cast<size_t>(joint.joint)].rotation;
    rotation = state.strength >= 1.0f ? turned : glm::slerp(rotation, turned, state.strength);
  }
}

}  // namespace lararium::human
