#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "shared/human/human.h"
#include "shared/human/locomotion.h"
#include "shared/human/turns.h"
#include "shared/human/two_bone_ik.h"

namespace lararium::human {
namespace {

constexpr glm::vec3 kDown(0.0f, -1.0f, 0.0f);
constexpr glm::vec3 kForward(0.0f, 0.0f, -1.0f);

constexpr float kForearmSpread = 0.35f;  // share of the upper arm's spread

// Rotations of the trunk's segments from rest, actor frame.
struct Trunk {
  glm::vec3 hips = glm::vec3(0.0f);  // shift of the root, metres
  glm::quat pelvis = kNoTurn;
  glm::quat chest = kNoTurn;
  glm::quat head = kNoTurn;
};

// Smooth minimum, never above the smaller value; metres.
float SoftMin(float a, float b) {
  constexpr float kSoftness = 0.010f;
  return std::min(a, b) - kSoftness * std::log1p(std::exp(-std::abs(a - b) / kSoftness));
}

class WalkingPose {
 public:
  WalkingPose(const LocomotionModel& model,
              const Skeleton& skeleton,
              const Locomotion& state,
              const IdleMotionSample& idle_motion,
              std::span<JointTransform> pose)
      : model_(model),
        body_(model.body),
        skeleton_(skeleton),
        state_(state),
        idle_motion_(idle_motion),
        pose_(pose) {
    turn_ = 2.0f * kPiF * static_cast<float>(state.phase - std::floor(state.phase));
    amount_ = state.amount;
    leg_ = body_.leg_length();
  }

  void Apply() {
    std::copy(skeleton_.rest.begin(), skeleton_.rest.end(), pose_.begin());
    Trunk trunk = TrunkOfWalk();
    if (body_.walks()) {
      SetPelvis(trunk);
    }
    SetChain(body_.spine, trunk.pelvis, trunk.chest);
    SetChain(body_.neck, trunk.chest, trunk.head);
    for (const int side : {kRight, kLeft}) {
      SetArm(side, trunk.chest);
      if (body_.walks()) {
        SetLeg(side);
      }
    }
  }

 private:
  const BodyRig::Leg& Leg(int side) const { return body_.legs[static_cast<size_t>(side)]; }
  const Locomotion::Foot& Foot(int side) const { return state_.feet[static_cast<size_t>(side)]; }
  const JointFrame& Rest(JointIndex joint) const { return body_.rest[static_cast<size_t>(joint)]; }
  glm::vec3 Actor(const glm::vec3& stage) const {
    return TurnY(-state_.heading) * (stage - state_.position);
  }

  // Angles and shifts by phase after Perry & Burnfield (2010): the pelvis turns 4 degrees forward
  // with the striking leg, drops 4 degrees on the swinging side, and moves 2 cm towards the
  // standing leg. The chest turns against it, and the trunk is highest above either leg.
  Trunk TrunkOfWalk() const {
    const float walking = std::min(amount_, 1.25f);
    const float sway = state_.style.sway;
    Trunk trunk;
    const float yaw = 0.070f * walking * std::cos(turn_);
    const float list = sway * 0.060f * walking * std::cos(turn_ - 0.9f);
    const float side_step = SideStep();
    const float shift = idle_motion_.weight_shift * state_.settled;
    trunk.hips.x = leg_ * (sway * 0.024f * walking * std::cos(turn_ - 0.6f * kPiF) +
                           0.035f * side_step + 0.036f * shift);
    const float bounce = std::cos(2.0f * (turn_ - 0.57f * kPiF));
    trunk.hips.y = leg_ * (-0.006f - walking * (0.036f - 0.024f * bounce));
    const float lean = Lean();
    const float bank = Bank();
    trunk.pelvis = TurnY(yaw) * TurnZ(list + 0.060f * shift + bank) * TurnX(-0.02f - 0.5f * lean);
    const float stoop = state_.style.stoop + lean + 0.04f * walking;
    trunk.chest = TurnY(-0.9f * yaw) *
                  TurnZ(-0.35f * list - 0.030f * shift + bank + 0.03f * side_step) *
                  TurnX(-0.02f - stoop);
    // The head stays level and leads into turns (Grasso et al., 1998).
    const float lead = std::clamp(0.28f * state_.turn_rate, -0.5f, 0.5f);
    trunk.head = TurnY(0.2f * yaw + lead) * TurnZ(0.3f * bank) *
                 TurnX(-0.25f * state_.style.stoop - 0.3f * lean -
                       0.008f * walking * std::cos(2.0f * turn_));
    return trunk;
  }

  // Stepping in place first moves the weight to the other foot: -1 .. 1, positive to the right.
  float SideStep() const {
    const float in_place = std::max(1.0f - 2.0f * amount_, 0.0f);
    float step = 0.0f;
    for (const int side : {kRight, kLeft}) {
      const float lifted = std::sin(kPiF * Foot(side).swing);  // 0 for a planted foot
      step -= SideSign(side) * lifted * lifted;
    }
    return in_place * step;
  }

  // Forward lean in radians when the body gains speed.
  float Lean() const {
    const glm::vec3 acceleration = TurnY(-state_.heading) * state_.acceleration;
    return std::clamp(-0.03f * acceleration.z, -0.08f, 0.10f);
  }

  // Lean into a curve: half of the angle that would balance it.
  float Bank() const {
    const glm::vec3 velocity = TurnY(-state_.heading) * state_.velocity;
    return std::clamp(0.5f * std::atan(-velocity.z * state_.turn_rate / 9.81f), -0.15f, 0.15f);
  }

  void SetPelvis(const Trunk& trunk) {
    const size_t root = static_cast<size_t>(body_.root);
    const JointFrame& rest = body_.rest[root];
    SetActorRotation(skeleton_, body_.root, trunk.pelvis * rest.rotation, pose_);
    glm::vec3 position = rest.position + trunk.hips;
    const float standing = position.y;
    position.y = SoftMin(position.y, SoftMin(HighestRoot(trunk, position, kRight),
                                             HighestRoot(trunk, position, kLeft)));
    // A foot leaves the floor before the body sinks further than this.
    position.y = std::max(position.y, standing - 0.35f * leg_);
    SetActorPosition(skeleton_, body_.root, position, pose_);
  }

  // Highest root at which an almost straight leg reaches its ankle.
  float HighestRoot(const Trunk& trunk, const glm::vec3& root, int side) const {
    const BodyRig::Leg& leg = Leg(side);
    const glm::vec3 hip_offset =
        trunk.pelvis * (Rest(leg.hip).position - Rest(body_.root).position);
    const glm::vec3 hip = root + hip_offset;
    const glm::vec3 ankle = Actor(Foot(side).ankle);
    const float across = glm::length(glm::vec2(ankle.x - hip.x, ankle.z - hip.z));
    const float length = 0.9985f * TwoBoneIk::kExact * (leg.upper_length + leg.lower_length);
    const float rise = std::sqrt(std::max(length * length - across * across, 0.0f));
    // A swinging foot follows the body; the leg need not reach it fully.
    const float swing = Foot(side).swing;
    const float slack = glm::smoothstep(0.0f, 0.3f, swing) - glm::smoothstep(0.5f, 1.0f, swing);
    return ankle.y + rise - hip_offset.y + 0.06f * slack;
  }

  // Spreads the rotation from below the chain to its end over its joints.
  void SetChain(const std::vector<JointIndex>& chain, const glm::quat& from, const glm::quat& to) {
    for (size_t i = 0; i < chain.size(); ++i) {
      const float share = static_cast<float>(i + 1) / static_cast<float>(chain.size());
      SetActorRotation(skeleton_, chain[i], glm::slerp(from, to, share) * Rest(chain[i]).rotation,
                       pose_);
    }
  }

  // Arms hang and swing against the legs: 24 degrees back to 8 degrees forward at a comfortable
  // speed, with 20 to 45 degrees at the elbow (Murray et al., 1967).
  void SetArm(int side, const glm::quat& chest) {
    const BodyRig::Arm& arm = body_.arms[static_cast<size_t>(side)];
    if (!arm.whole()) {
      return;
    }
    const float swing_amount = state_.style.arm_swing * std::min(amount_, 1.3f);
    const float own = turn_ + (side == kRight ? 0.0f : kPiF);
    const float swing = 0.04f - 0.13f * swing_amount - 0.28f * swing_amount * std::cos(own) +
                        0.8f * state_.style.stoop;
    const float elbow =
        0.24f + 0.10f * swing_amount + 0.18f * swing_amount * std::cos(own - 1.1f * kPiF);
    const glm::vec3 elbow_rest = Rest(arm.elbow).position;
    const glm::vec3 upper = glm::normalize(elbow_rest - Rest(arm.shoulder).position);
    const glm::vec3 lower = glm::normalize(Rest(arm.wrist).position - elbow_rest);
    const float spread = model_.arm_spread + state_.style.arm_spread;
    const glm::quat hang = Arc(upper, kDown);
    const glm::quat straight = Arc(hang * lower, kDown) * hang;
    const glm::quat upper_turn = TurnX(swing) * TurnZ(SideSign(side) * spread) * hang;
    const glm::quat lower_turn =
        TurnX(swing + elbow) * TurnZ(SideSign(side) * kForearmSpread * spread) * straight;
    SetActorRotation(skeleton_, arm.shoulder, chest * upper_turn * Rest(arm.shoulder).rotation,
                     pose_);
    SetActorRotation(skeleton_, arm.elbow, chest * lower_turn * Rest(arm.elbow).rotation, pose_);
  }

  void SetLeg(int side) {
    const BodyRig::Leg& leg = Leg(side);
    const Locomotion::Foot& foot = Foot(side);
    const float heading = std::remainder(foot.print.heading - state_.heading, 2.0f * kPiF);
    TwoBoneIk ik;
    ik.upper = leg.hip;
    ik.lower = leg.knee;
    ik.end = leg.ankle;
    ik.target = Actor(foot.ankle);
    // The knee points between the directions of the body and of the foot.
    ik.pole = TurnY(kKneeTurn * heading) * kForward;
    ik.hinge = glm::vec3(1.0f, 0.0f, 0.0f);
    ik.Solve(skeleton_, body_, pose_);
    const glm::quat sole = TurnY(heading) * TurnX(foot.print.slope_pitch) *
                           TurnZ(foot.print.slope_roll) * TurnX(foot.pitch);
    const glm::quat straight = TurnY(-leg.toe_out);
    SetActorRotation(skeleton_, leg.ankle, sole * straight * Rest(leg.ankle).rotation, pose_);
    const glm::quat toes = sole * TurnX(foot.toe_bend) * straight;
    for (const JointIndex toe : leg.toes) {
      SetActorRotation(skeleton_, toe, toes * Rest(toe).rotation, pose_);
    }
  }

  const LocomotionModel& model_;
  const BodyRig& body_;
  const Skeleton& skeleton_;
  const Locomotion& state_;
  const IdleMotionSample& idle_motion_;
  std::span<JointTransform> pose_;
  float turn_ = 0.0f;  // phase of the stride, radians
  float amount_ = 0.0f;
  float leg_ = 0.0f;
};

// True for joints of the arms and their descendants.
std::vector<bool> FindArmJoints(const Skeleton& skeleton, const BodyRig& body) {
  std::vector<bool> of_arm(skeleton.size(), false);
  for (size_t i = 0; i < skeleton.size(); ++i) {
    const auto joint = static_cast<JointIndex>(i);
    const int16_t parent = skeleton.parents[i];
    of_arm[i] = parent != Skeleton::kNoParent && of_arm[static_cast<size_t>(parent)];
    for (const BodyRig::Arm& arm : body.arms) {
      of_arm[i] = of_arm[i] || joint == arm.clavicle || joint == arm.shoulder;
    }
  }
  return of_arm;
}

// Half the width of the body without arms between two heights in the bind pose.
float HalfWidth(const Human& human, const BodyRig& body, float low, float high) {
  const std::vector<bool> of_arm = FindArmJoints(human.skeleton, body);
  float half = 0.0f;
  for (const SkinnedMesh& mesh : human.meshes) {
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
      const glm::vec3& at = mesh.positions[v];
      if (at.y < low || at.y > high || std::abs(at.x) <= half) {
        continue;
      }
      float arm = 0.0f;
      for (int k = 0; k < 4; ++k) {
        arm += of_arm[mesh.joints[v][static_cast<size_t>(k)]] ? mesh.weights[v][k] : 0.0f;
      }
      half = arm < 0.1f ? std::abs(at.x) : half;
    }
  }
  return half;
}

}  // namespace

LocomotionModel MakeLocomotionModel(const Human& human, const BodyRig& body) {
  constexpr float kLeast = 0.12f, kMost = 0.50f;  // radians
  constexpr float kHand = 0.045f;                 // metres: half a hand and a gap
  LocomotionModel model;
  model.body = body;
  const BodyRig::Arm& arm = body.arms[kRight];
  if (!arm.whole() || !body.arms[kLeft].whole()) {
    return model;
  }
  const glm::vec3 shoulder = body.rest[static_cast<size_t>(arm.shoulder)].position;
  const float wrist_height = shoulder.y - arm.upper_length - arm.lower_length;
  const float hips = HalfWidth(human, body, wrist_height - 0.4f * arm.lower_length,
                               wrist_height + 0.4f * arm.lower_length);
  const auto wrist = [&](float spread) {
    return shoulder.x + arm.upper_length * std::sin(spread) +
           arm.lower_length * std::sin(kForearmSpread * spread);
  };
  model.arm_spread = kLeast;
  while (model.arm_spread < kMost && wrist(model.arm_spread) < hips + kHand) {
    model.arm_spread += 0.01f;
  }
  return model;
}

void ApplyLocomotion(const LocomotionModel& model,
                     const Skeleton& skeleton,
                     const Locomotion& state,
                     const IdleMotionSample& idle_motion,
                     std::span<JointTransform> pose) {
  WalkingPose(model, skeleton, state, idle_motion, pose).Apply();
}

}  // namespace lararium::human
